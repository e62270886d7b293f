#include "core/render/render.h"

#include <fmt/format.h>

namespace ptb {

namespace {

/// Left to itself, a runtime takes a divisor of the range as work-group, which of a prime number is 1 (on an
/// H200 five times slower than 64).
constexpr int implicit_multiple = 64;

std::size_t round_up(std::uint64_t value, int multiple) {
    const auto m = static_cast<std::uint64_t>(multiple);
    return static_cast<std::size_t>((value + m - 1) / m * m);
}

std::string describe(const cl::NDRange& range) {
    if (range.dimensions() == 0) return "implicit";
    std::string text = std::to_string(range.get()[0]);
    for (std::size_t i = 1; i < range.dimensions(); ++i) text += fmt::format("x{}", range.get()[i]);
    return text;
}

/// One of an event's times, 0 where the driver has none.
std::uint64_t time_ns(const cl::Event& event, cl_profiling_info name) {
    cl_ulong ns = 0;
    const cl_int code = clGetEventProfilingInfo(event(), name, sizeof ns, &ns, nullptr);
    if (code == CL_PROFILING_INFO_NOT_AVAILABLE) return 0;
    if (code != CL_SUCCESS) throw cl::Error(code, "clGetEventProfilingInfo");
    return ns;
}

}  // namespace

std::vector<LaunchTimes> times_of(const std::vector<cl::Event>& events, const ocl::Device& device) {
    return ocl::checked("profiling", device.info.name, [&] {
        std::vector<LaunchTimes> times;
        for (const cl::Event& event : events) {
            event.wait();
            times.emplace_back();
            if (!device.info.profiling) continue;
            times.back() = {
                time_ns(event, CL_PROFILING_COMMAND_QUEUED), time_ns(event, CL_PROFILING_COMMAND_SUBMIT),
                time_ns(event, CL_PROFILING_COMMAND_START), time_ns(event, CL_PROFILING_COMMAND_END)};
        }
        return times;
    });
}

std::uint64_t paths_per_item(const ocl::Device& device, const Scene& scene, int path_length) {
    const std::uint64_t turns_per_segment = scene.spheres.size() + 2;
    return ocl::loop_limit(device.info) / (turns_per_segment * static_cast<std::uint64_t>(path_length) + 4);
}

Ranges one_dimensional(std::uint64_t items, int work_group_x) {
    if (work_group_x == 0) return {cl::NDRange(round_up(items, implicit_multiple)), cl::NullRange};
    return {cl::NDRange(round_up(items, work_group_x)), cl::NDRange(static_cast<std::size_t>(work_group_x))};
}

Ranges two_dimensional(int width, int rows, int work_group_x, int work_group_y) {
    return {cl::NDRange(round_up(static_cast<std::uint64_t>(width), work_group_x),
                        round_up(static_cast<std::uint64_t>(rows), work_group_y)),
            cl::NDRange(static_cast<std::size_t>(work_group_x), static_cast<std::size_t>(work_group_y))};
}

std::string describe(const Ranges& ranges) {
    return fmt::format("global {}, local {}", describe(ranges.global), describe(ranges.local));
}

}  // namespace ptb
