#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

/// Whether NVIDIA's compiler is the device's, with options of its own.
bool takes_nvidia_options(const Device& device);

/// Compiles and links. Throws BuildError with the driver's log when the text does not compile, Error
/// otherwise.
Program build(const Device& device, const KernelSource& source, const std::string& options);

/// What a compiler's log tells of a kernel.
struct LogFacts {
    std::optional<std::uint64_t> registers, spill_store_bytes, spill_load_bytes;
    bool operator==(const LogFacts&) const = default;
};

/// NVIDIA's compiler tells on request; of other drivers' logs nothing is known.
LogFacts log_facts(std::string_view log, std::string_view kernel);

/// What the driver says of a built kernel, and of the program it is part of.
struct KernelFacts {
    std::uint64_t max_work_group = 0, preferred_multiple = 0, local_bytes = 0, private_bytes = 0;
    std::optional<std::uint64_t> binary_bytes;
    LogFacts log;
};

KernelFacts kernel_facts(const Device& device, const cl::Kernel& kernel);

}  // namespace ptb::ocl
