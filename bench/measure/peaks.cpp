#include "bench/measure/peaks.h"

#include <algorithm>

#include "bench/measure/clock.h"
#include "bench/measure/method.h"
#include "core/ocl/peak_launch.h"

namespace ptb {
namespace {

using ocl::PeakLaunch;
using ocl::PeakLaunches;

constexpr StopRule stop{10, 200, 0.5};

struct Kind {
    const char *name, *unit;
    PeakLaunch (PeakLaunches::*prepare)();
};
constexpr Kind kinds[] = {{"fma", "GFLOP/s", &PeakLaunches::fma},
                          {"sqrt", "Groots/s", &PeakLaunches::root},
                          {"division", "Gdivisions/s", &PeakLaunches::division},
                          {"global", "GB/s", &PeakLaunches::global},
                          {"constant", "GB/s", &PeakLaunches::constant},
                          {"launch", "us", &PeakLaunches::nothing}};

/// A launch in the place of a render, for the sampler to time.
class LaunchRender : public Render {
  public:
    LaunchRender(const ocl::Device& device, const PeakLaunch& launch) : device_(device), launch_(launch) {}
    void restart() override { left_ = 1; }
    std::uint64_t samples_left() const override { return left_; }
    std::vector<LaunchTimes> advance(std::uint64_t) override {
        cl::Event event;
        ocl::checked("peaks", device_.info.name, [&] {
            device_.queue.enqueueNDRangeKernel(launch_.kernel, cl::NullRange, cl::NDRange(launch_.items),
                                               cl::NDRange(static_cast<std::size_t>(launch_.per_group)),
                                               nullptr, &event);
            device_.queue.finish();
        });
        left_ = 0;
        return times_of({event}, device_);
    }
    Film read_film() override { return {}; }
    ocl::KernelFacts facts() const override { return {}; }
    std::uint64_t device_bytes() const override { return 0; }

  private:
    const ocl::Device& device_;
    const PeakLaunch& launch_;
    std::uint64_t left_ = 1;
};

/// Amounts per nanosecond are billions a second; a launch that does nothing has its duration, in
/// microseconds.
void rate(Peak& peak, double amount, const Statistics& s) {
    const auto rated = [&](double ns) { return amount > 0 ? amount / ns : ns / 1e3; };
    peak.n = s.n;
    peak.timer = s.timer;
    if (s.median_ns <= 0) return;
    peak.value = rated(s.median_ns);
    if (!s.ci_low_ns || !s.ci_high_ns) return;
    peak.low = std::min(rated(*s.ci_low_ns), rated(*s.ci_high_ns));
    peak.high = std::max(rated(*s.ci_low_ns), rated(*s.ci_high_ns));
}

void measure(Peak& peak, const ocl::Device& device, const PeakLaunch& launch, LaunchRender& render,
             const std::string& timer, const Progress& progress) {
    TimerWatch watch(launch.amount > 0 ? timer : "host");
    PassCutter cutter;
    const std::uint64_t resolution_ns = device.info.timer_resolution_ns;
    const auto take = [&](const std::string&, int renders) {
        return timed_render(render, {cutter, resolution_ns, progress, renders});
    };
    const std::int64_t begin = now_ns();
    const Measurement measurement = measure({stop, std::nullopt, 0, resolution_ns}, watch, take,
                                            [begin] { return seconds_since(begin); });
    peak.reason = wrong_times(measurement, watch, {device.info.type == "CPU", look_around()});
    rate(peak, launch.amount, describe(measurement, watch));
}

Peak measured(const Kind& kind, const ocl::Device& device, PeakLaunches& launches, const std::string& timer,
              const Progress& progress) {
    Peak peak;
    peak.name = kind.name;
    peak.unit = kind.unit;
    try {
        const PeakLaunch launch = (launches.*kind.prepare)();
        LaunchRender render(device, launch);
        render.advance(1);  // which may compile
        peak.reason = launches.wrong_result(launch);
        if (peak.reason.empty()) measure(peak, device, launch, render, timer, progress);
    } catch (const ocl::Error& error) {
        peak.reason = error.what();
    }
    return peak;
}

}  // namespace

std::vector<Peak> measure_peaks(const ocl::Device& device, const std::string& timer,
                                const std::string& kernel_dir,
                                const std::function<void(const std::string&)>& told) {
    PeakLaunches launches(device, kernel_dir);
    std::vector<Peak> peaks;
    for (const Kind& kind : kinds) {
        const auto progress = [&](double) {
            told(kind.name);
            return true;
        };
        progress(0);
        peaks.push_back(measured(kind, device, launches, timer, progress));
    }
    return peaks;
}

}  // namespace ptb
