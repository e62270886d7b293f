#include "core/render/launcher.h"

#include <algorithm>

namespace ptb {

namespace {

constexpr std::uint64_t slices_out_of_order = 4;
constexpr std::uint64_t tasks_per_compute_unit = 16;

cl::CommandQueue queue_of(const ocl::Device& device, const Variant& variant) {
    if (variant.queue == QueueOrder::in_order) return device.queue;
    const cl_command_queue_properties profiling = device.info.profiling ? CL_QUEUE_PROFILING_ENABLE : 0;
    return {device.context, device.device, profiling | CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE};
}

}  // namespace

Launcher::Launcher(const ocl::Device& device, const Variant& variant)
    : device_(device), variant_(variant), queue_(queue_of(device, variant)) {}

std::uint64_t Launcher::slices(std::uint64_t pieces) const {
    const auto units = static_cast<std::uint64_t>(std::max(device_.info.compute_units, 1));
    std::uint64_t wanted = variant_.queue == QueueOrder::out_of_order ? slices_out_of_order : 1;
    if (variant_.dispatch == Dispatch::tasks) wanted = tasks_per_compute_unit * units;
    return std::clamp<std::uint64_t>(pieces, 1, wanted);
}

Ranges Launcher::ranges(std::uint64_t items, int work_group_x) const {
    if (variant_.dispatch == Dispatch::tasks) return {cl::NDRange(1), cl::NDRange(1)};
    return one_dimensional(items, work_group_x);
}

void Launcher::launch(const cl::Kernel& kernel, const Ranges& ranges) {
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, ranges.global, ranges.local, nullptr,
                                &events_.emplace_back());
}

void Launcher::barrier() {
    if (variant_.queue == QueueOrder::out_of_order) queue_.enqueueBarrierWithWaitList();
}

std::vector<LaunchTimes> Launcher::finish() {
    queue_.finish();
    const std::vector<cl::Event> events = std::move(events_);
    events_.clear();
    return times_of(events, device_);
}

}  // namespace ptb
