#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/render/render.h"

namespace ptb {

/// Launches of one pass, in the way of a variant: on one queue, in order, or on one that is not, where what
/// lies between two barriers may overlap. Methods throw cl::Error.
class Launcher {
  public:
    Launcher(const ocl::Device& device, const Variant& variant);

    /// Independent launches that a pass of so many pieces of work is cut into: one; four out of order; as
    /// tasks as many as keep the device's compute units busy, were they to overlap.
    std::uint64_t slices(std::uint64_t pieces) const;

    /// The range for a slice of `items` work-items: one item where slices are tasks.
    Ranges ranges(std::uint64_t items, int work_group_x) const;

    void launch(const cl::Kernel& kernel, const Ranges& ranges);
    /// What follows waits for what was enqueued.
    void barrier();
    const cl::CommandQueue& queue() const { return queue_; }
    /// Waits for all; the times of the launches since the last call.
    std::vector<LaunchTimes> finish();

  private:
    ocl::Device device_;
    Variant variant_;
    cl::CommandQueue queue_;
    std::vector<cl::Event> events_;
};

}  // namespace ptb
