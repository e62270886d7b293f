#pragma once

#include <string>

#include "core/render/render.h"

namespace ptb {

/// The language's version, and what `build` says of arithmetic: the options that every kernel gets.
std::string common_options(const ocl::Device& device, const RenderJob& job);

/// Why this device cannot launch a job's variant, or nothing.
std::string launch_refusal(const ocl::Device& device, const RenderJob& job);

/// "rng hash: thesis has auto, park_miller" when the variant's value of the axis is none of `has`, or
/// nothing.
std::string choice_refusal(const std::string& integrator, const std::string& axis, const Variant& variant,
                           const std::vector<std::string>& has);

}  // namespace ptb
