#include "core/ocl/peak_launch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ptb::ocl {
namespace {

constexpr int chains = 8;                                                ///< of the kernels
constexpr cl_uint fast_steps = 32768, slow_steps = 4096;                 ///< llvmpipe ends loops after 65535
constexpr cl_uint table_size = 1024;                                     ///< of the kernel
constexpr int most_lanes = 16;                                           ///< with built-in functions
constexpr std::uint64_t most_data = 1u << 30, most_cpu_data = 1u << 29;  ///< bytes

/// A CPU's work-items with lanes each are a work-group: each reads a piece of memory of its own.
int items_a_group(const DeviceInfo& device) {
    if (device.default_lanes > 1) return 1;
    return static_cast<int>(std::min<std::uint64_t>(256, device.max_work_group));
}

std::uint64_t busy_items(const DeviceInfo& device) {
    const auto cores = static_cast<std::uint64_t>(std::max(device.compute_units, 1));
    return cores * (device.type == "CPU" ? 256 : 2048);
}

}  // namespace

PeakLaunches::PeakLaunches(const Device& device, const std::string& kernel_dir)
    : device_(device),
      lanes_(std::min(device.info.default_lanes, most_lanes)),
      per_group_(items_a_group(device.info)),
      items_(busy_items(device.info)),
      program_(build(device, kernel_source("probe/peaks.cl", kernel_dir),
                     fmt::format("-cl-std=CL1.2 -DPTB_LANES={}", lanes_))) {
    for (int i = 0; i < chains * lanes_; ++i) starts_.push_back(static_cast<float>(1 + i));
    out_ = buffer(items_ * sizeof(float));
    starts_buffer_ = buffer(starts_.size() * sizeof(float));
    checked("peaks", device_.info.name, [&] {
        device_.queue.enqueueWriteBuffer(starts_buffer_, CL_TRUE, 0, starts_.size() * sizeof(float),
                                         starts_.data());
    });
}

PeakLaunch PeakLaunches::fma() {
    return arithmetic("peak_fma", 2, fast_steps, [](double x, double steps) { return x + steps; });
}

PeakLaunch PeakLaunches::root() {
    return arithmetic("peak_sqrt", 1, slow_steps,
                      [](double x, double steps) { return std::sqrt(x * x + steps); });
}

PeakLaunch PeakLaunches::division() {
    return arithmetic("peak_division", 1, slow_steps,
                      [](double x, double steps) { return 1 / (1 / x + steps); });
}

PeakLaunch PeakLaunches::global() {
    const DeviceInfo& info = device_.info;
    const auto room = std::min(
        {info.type == "CPU" ? most_cpu_data : most_data, info.max_alloc_bytes, info.global_bytes / 8});
    const std::uint64_t wide = lanes_ == 1 ? 4 : static_cast<std::uint64_t>(lanes_);
    const std::uint64_t steps =
        std::clamp<std::uint64_t>(room / sizeof(float) / wide / items_, 1, loop_limit(info) / 2);
    const std::uint64_t numbers = steps * wide * items_;
    data_ = ones(numbers);
    PeakLaunch launch = prepared("peak_global", static_cast<double>(numbers * sizeof(float)));
    launch.result = static_cast<double>(steps * wide);
    launch.kernel.setArg(1, data_);
    launch.kernel.setArg(2, static_cast<cl_uint>(steps));
    return launch;
}

PeakLaunch PeakLaunches::constant() {
    table_ = ones(table_size);
    const double reads = chains * static_cast<double>(fast_steps);
    PeakLaunch launch = prepared("peak_constant", reads * sizeof(float) * static_cast<double>(items_));
    launch.result = reads * lanes_;
    launch.kernel.setArg(1, table_);
    launch.kernel.setArg(2, fast_steps);
    return launch;
}

PeakLaunch PeakLaunches::nothing() {
    PeakLaunch launch = prepared("peak_nothing", 0);
    launch.items = 1;
    launch.per_group = 1;
    launch.result = 1;
    return launch;
}

std::string PeakLaunches::wrong_result(const PeakLaunch& launch) const {
    std::vector<float> out(launch.items);
    checked("peaks", device_.info.name, [&] {
        device_.queue.enqueueReadBuffer(out_, CL_TRUE, 0, out.size() * sizeof(float), out.data());
        device_.queue.enqueueFillBuffer(out_, NAN, 0, out.size() * sizeof(float));
        device_.queue.finish();
    });
    for (const float value : out)
        if (!(std::abs(value - launch.result) <= launch.tolerance * launch.result))
            return fmt::format("wrong result: found {}, allowed: {}", value, launch.result);
    return "";
}

cl::Buffer PeakLaunches::buffer(std::uint64_t bytes) const {
    return checked("peaks", device_.info.name,
                   [&] { return cl::Buffer(device_.context, CL_MEM_READ_WRITE, bytes); });
}

cl::Buffer PeakLaunches::ones(std::uint64_t count) const {
    const cl::Buffer made = buffer(count * sizeof(float));
    checked("peaks", device_.info.name, [&] {
        device_.queue.enqueueFillBuffer(made, 1.0f, 0, count * sizeof(float));
        device_.queue.finish();
    });
    return made;
}

PeakLaunch PeakLaunches::prepared(const char* name, double amount) const {
    return checked(name, device_.info.name, [&] {
        cl::Kernel kernel(program_.program, name);
        kernel.setArg(0, out_);
        return PeakLaunch{kernel, items_, per_group_, amount};
    });
}

/// Each operation takes an x to the next; `after` says where `steps` of them take it.
PeakLaunch PeakLaunches::arithmetic(const char* name, int operations, cl_uint steps,
                                    double (*after)(double x, double steps)) const {
    const double numbers = static_cast<double>(chains * lanes_) * static_cast<double>(items_);
    PeakLaunch launch = prepared(name, operations * numbers * steps);
    launch.kernel.setArg(1, starts_buffer_);
    launch.kernel.setArg(2, steps);
    launch.kernel.setArg(3, 1.0f);
    for (const float start : starts_) launch.result += after(start, steps);
    launch.tolerance = operations == 2 ? 0 : 0.01;  // whole numbers are exact, roots round at each step
    return launch;
}

}  // namespace ptb::ocl
