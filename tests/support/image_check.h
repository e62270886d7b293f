#pragma once

#include <string>

#include <gtest/gtest.h>

#include "bench/validate/validate.h"
#include "core/oracle/oracle.h"

namespace ptb {

/// The result of a host tracer as a reference.
Reference reference_of(const OracleResult& truth, const Scene& scene, const std::string& kernel,
                       const OracleJob& job);

/// Judges a film against a reference. When it is wrong, leaves NAME_image.png, NAME_reference.png and
/// NAME_z.png (blue: too dark, red: too bright, full colour at 5 standard errors) in the build folder and
/// says where.
testing::AssertionResult agrees(const std::string& name, const Film& film, const RenderJob& job,
                                const Reference& reference);

}  // namespace ptb
