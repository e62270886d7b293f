#pragma once

#include <cstdint>
#include <string>

#include "core/ocl/device.h"
#include "core/source/source.h"

namespace ptb::ocl {

/// A kernel text built for one device.
struct Program {
    cl::Program program;
    std::string options;
    std::string kernel_hash;
    bool overridden = false;
    std::string log;  ///< the driver's, warnings included
};

/// Compiles and links. Throws BuildError with the driver's log when the text does not compile, Error
/// otherwise.
Program build(const Device& device, const KernelSource& source, const std::string& options);

/// What the driver says of a built kernel.
struct KernelFacts {
    std::uint64_t max_work_group = 0, preferred_multiple = 0, local_bytes = 0, private_bytes = 0;
};

KernelFacts kernel_facts(const Device& device, const cl::Kernel& kernel);

}  // namespace ptb::ocl
