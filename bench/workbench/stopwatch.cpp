#include "bench/workbench/stopwatch.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "bench/measure/clock.h"
#include "bench/measure/statistics.h"
#include "bench/workbench/outcome.h"

namespace ptb {
namespace {

double steady_s() { return seconds_since(0); }

/// Waits, and says so.
std::function<void(double s)> waiting(const Stage& stage) {
    return [&stage](double s) {
        for (const std::int64_t begin = now_ns(); seconds_since(begin) < s;) {
            stage("idle", seconds_since(begin) / s);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    };
}

}  // namespace

Stopwatch::Stopwatch(Builds& builds, Pace& pace, const MeasureOptions& options)
    : builds_(builds),
      pace_(pace),
      options_(options),
      timer_(options.timer),
      disturbances_(builds.device()),
      gpu_(nvml_gpu(builds.device().info)) {}

void Stopwatch::rest(const Stage& stage) {
    if (!energy_) energy_.emplace(energy_counter(device()), steady_s, waiting(stage));
}

Method Stopwatch::method(double render_s, double time_left_s) const {
    return {{options_.min_samples, options_.max_samples, options_.max_time_s, time_left_s},
            options_.warmup,
            render_s,
            device().timer_resolution_ns};
}

TakeSample Stopwatch::samples_of(const CaseJob& job, Render& render, double render_s, const Stage& stage,
                                 Work& work) {
    return [=, this, &job, &render, &stage, &work, timing = false](const std::string& name,
                                                                   int renders) mutable {
        if (!timing) energy_->restart();
        timing = name == "sample";
        disturbances_.begin(render_s * renders);
        TimedRender timed = timed_render(render, pace_.timing(job, passes(stage, name), renders));
        energy_->add(renders);
        disturbances_.end(timed.time);
        work.passes = timed.passes;
        work.longest_launch_ns = std::max(work.longest_launch_ns, timed.longest_launch_ns);
        return timed;
    };
}

void Stopwatch::refuse_wrong_clock() const {
    if (options_.timer == "event" && !timer_.fault().empty())
        throw Unsupported(fmt::format("--timer event: {}; auto takes the host's clock then", timer_.fault()));
}

Measurement Stopwatch::time(const CaseJob& job, Render& render, double time_left_s, const Stage& stage,
                            Record& record) {
    Work& work = *record.work;
    const double render_s = pace_.ns_per_sample(job) * static_cast<double>(work.samples) * 1e-9;
    timer_.restart();
    const TakeSample take = samples_of(job, render, render_s, stage, work);
    const std::int64_t begin = now_ns();
    Measurement measurement =
        measure(method(render_s, time_left_s), timer_, take, [begin] { return seconds_since(begin); });
    refuse_wrong_clock();
    if (gpu_) record.gpu = gpu_->state();
    record.energy = energy_->spent(work.samples);
    return measurement;
}

void Stopwatch::summarize(const Measurement& measurement, Record& record) const {
    record.samples = measurement.samples;
    record.work->renders = measurement.renders;
    if (record.params.variant.queue == QueueOrder::out_of_order)
        record.work->overlap = overlap_of(measurement.samples);
    Statistics statistics = describe(measurement, timer_);
    const std::string unstable = unstable_reason(measurement, timer_, disturbances_.place());
    if (!unstable.empty()) conclude(record, Status::unstable, unstable);
    if (statistics.median_ns <= 0) return;
    add_rates(statistics, *record.work);
    record.statistics = statistics;
}

}  // namespace ptb
