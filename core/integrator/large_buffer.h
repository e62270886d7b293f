#pragma once

#include <cstddef>
#include <span>

#include "core/ocl/device.h"

namespace ptb {

/// A buffer of much memory that a device reads here and there. A CPU reads it in place, in large pages where
/// the system has them: with small ones a tenth of the time goes into finding addresses. Throws cl::Error.
cl::Buffer large_buffer(const ocl::Device& device, std::span<const std::byte> content);

}  // namespace ptb
