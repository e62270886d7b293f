#include "bench/measure/disturbance.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include "bench/measure/clock.h"
#include "bench/measure/timer.h"
#include "core/render/render.h"

namespace ptb {

namespace {

constexpr cl_uint probe_steps = 16384;   ///< some 30 us of a CPU, 200 us of a GPU
constexpr int probe_launches = 5;        ///< the fastest counts: an interrupt is not a low clock
constexpr double probe_share = 0.01;     ///< of a sample's time, at most
constexpr double least_counted_s = 0.1;  ///< the system counts in ticks of 10 ms

CpuTicks cpu_ticks() {
    std::ifstream file("/proc/stat");
    std::string line;
    std::getline(file, line);
    return parse_cpu_ticks(line);
}

}  // namespace

ClockProbe::ClockProbe(const ocl::Device& device)
    : device_(device), program_(ocl::build(device, kernel_source("probe/clock.cl"), "-cl-std=CL1.2")) {
    ocl::checked("probe_clock", device_.info.name, [&] {
        kernel_ = cl::Kernel(program_.program, "probe_clock");
        out_ = cl::Buffer(device_.context, CL_MEM_READ_WRITE, sizeof(cl_uint));
        device_.queue.enqueueFillBuffer(out_, cl_uint{1}, 0, sizeof(cl_uint));
        kernel_.setArg(0, out_);
        kernel_.setArg(1, probe_steps);
    });
    run();  // which may compile
    run();
}

std::int64_t ClockProbe::run() {
    const std::int64_t begin = now_ns();
    std::vector<cl::Event> events(probe_launches);
    ocl::checked("probe_clock", device_.info.name, [&] {
        for (cl::Event& event : events)
            device_.queue.enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(1), cl::NDRange(1),
                                               nullptr, &event);
        device_.queue.finish();
    });
    const auto launches = times_of(events, device_);
    const std::int64_t host_ns = now_ns() - begin;
    cost_s_ = static_cast<double>(host_ns) * 1e-9;
    if (!timer_fault(launches, host_ns, device_.info.timer_resolution_ns).empty()) return 0;
    std::int64_t shortest = host_ns;
    for (const LaunchTimes& t : launches) shortest = std::min(shortest, union_ns({&t, 1}));
    return shortest;
}

/// A device that cannot run the probe does without.
bool Disturbances::make_probe() {
    if (probe_ || no_probe_) return probe_ != nullptr;
    try {
        probe_ = std::make_unique<ClockProbe>(device_);
    } catch (const std::exception&) {
        no_probe_ = true;
    }
    return probe_ != nullptr;
}

void Disturbances::begin(double predicted_s) {
    counting_ = device_.info.type == "CPU" && predicted_s >= least_counted_s;
    probing_ =
        predicted_s >= least_counted_s && make_probe() && probe_->cost_s() <= probe_share * predicted_s;
    if (counting_) ticks_ = cpu_ticks();
}

void Disturbances::end(TimeSample& sample) {
    if (counting_ && stolen(ticks_, cpu_ticks())) sample.cause = cause::steal;
    if (!probing_) return;
    sample.probe_ns = probe_->run();
    if (clock_.low(sample.probe_ns)) sample.cause = cause::clock_low;
}

}  // namespace ptb
