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

constexpr cl_uint probe_steps = 16384;  ///< some 30 us of a CPU, 200 us of a GPU
constexpr int probe_launches = 5;       ///< the fastest counts: an interrupt is not a low clock
constexpr double probe_share = 0.01;    ///< of a sample's time, at most
constexpr double least_probed_s = 0.1;
constexpr double least_ticking_s = 0.1;      ///< what is stolen is counted in ticks of 10 ms
constexpr double least_scheduled_s = 0.005;  ///< of the scheduler, in ns; reading them takes some 50 us

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
    counting_ = place_.cpu_device && predicted_s >= least_scheduled_s;
    counting_ticks_ = place_.cpu_device && predicted_s >= least_ticking_s;
    probing_ = predicted_s >= least_probed_s && make_probe() && probe_->cost_s() <= probe_share * predicted_s;
    if (counting_ticks_) ticks_ = cpu_ticks();
    if (counting_) scheduled_ = scheduled_process();
    began_ns_ = now_ns();
}

/// The cause, where others took CPU time of the sample that ends now.
std::string Disturbances::taken_by_others() const {
    const auto wall_ns = static_cast<double>(now_ns() - began_ns_);
    if (counting_ &&
        lost_share(scheduled_, scheduled_process(), wall_ns, usable_cpus(place_.host)) > loss_limit)
        return cause::busy;
    if (counting_ticks_ && stolen_share(ticks_, cpu_ticks()) > loss_limit) return cause::steal;
    return "";
}

void Disturbances::end(TimeSample& sample) {
    const std::string taken = taken_by_others();
    if (!taken.empty() && sample.cause != cause::timer_fault) sample.cause = taken;
    if (probing_) sample.probe_ns = probe_->run();
}

}  // namespace ptb
