#pragma once

#include <cstdint>
#include <optional>

#include "core/ocl/program.h"

namespace ptb {

/// Added to a kernel's options, it makes the instrumented build.
inline constexpr const char* count_option = " -DPTB_COUNT";

/// What an instrumented kernel says that it did: see kernels/shared/counts.h.
struct Counts {
    std::uint64_t segments = 0, lanes = 0, flops = 0, roots = 0, divisions = 0, bytes = 0;
    std::uint64_t searches = 0, nodes = 0, triangles = 0;  ///< of a tree, where there are meshes
    bool operator==(const Counts&) const = default;
};

/// Where kernels of one program leave their counts; nothing unless it is an instrumented build. Methods throw
/// ocl::Error.
class CountedRows {
  public:
    CountedRows(const ocl::Device& device, const ocl::Program& program);
    /// Sets the last argument of an instrumented kernel.
    void give(cl::Kernel& kernel) const;
    void clear() const;
    std::optional<Counts> read() const;

  private:
    ocl::Device device_;
    std::optional<cl::Buffer> rows_;
};

}  // namespace ptb
