#pragma once

#include <cstdint>
#include <string>

#include "core/render/render.h"

namespace ptb {

/// Build options of `pt` for a job.
std::string engine_options(const ocl::Device& device, const Scene& scene, const RenderJob& job);

/// Why `pt` does not do a job of this variant on this device, or nothing.
std::string engine_refusal(const ocl::Device& device, const Scene& scene, const RenderJob& job);

/// Of the grid of cells that stratified samples of a pixel lie in, one each: the largest divisor of spp that
/// is not above its root.
std::uint32_t strata_columns(std::uint32_t spp);

/// One that wants thousands of work-items: all but CPUs.
bool is_throughput_device(const ocl::Device& device);

}  // namespace ptb
