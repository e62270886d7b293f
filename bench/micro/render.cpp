#include <algorithm>
#include <map>
#include <memory>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench/measure/sampler.h"
#include "bench/micro/benchmarks.h"
#include "bench/plan/data_dir.h"
#include "core/integrator/registry.h"

namespace ptb {

namespace {

/// What a render benchmark works on, made when the first one runs: most runs are filtered.
class DeviceBench {
  public:
    explicit DeviceBench(std::string key) : key_(std::move(key)) {}

    const Scene& scene() {
        if (!scene_) scene_ = load_scene(data_dir() / "configs/scenes/thesis.json");
        return *scene_;
    }
    const ocl::Device& device() {
        if (!device_) device_ = ocl::open_device(key_);
        return *device_;
    }
    const ocl::Program& program(const Integrator& kernel, const RenderJob& job) {
        const auto found = programs_.find(kernel.id);
        if (found != programs_.end()) return found->second;
        return programs_
            .emplace(kernel.id, ocl::build(device(), kernel_source(kernel.file()),
                                           kernel.options(device(), scene(), job)))
            .first->second;
    }

  private:
    std::string key_;
    std::optional<Scene> scene_;
    std::optional<ocl::Device> device_;
    std::map<std::string, ocl::Program> programs_;
};

RenderJob job_of(const Integrator& kernel, const DeviceInfo& device, int spp) {
    RenderJob job;
    job.size = {256, 256};
    job.spp = spp;
    job.path_length = 16;
    const bool has =
        std::find(kernel.lanes.begin(), kernel.lanes.end(), device.default_lanes) != kernel.lanes.end();
    job.lanes = has ? device.default_lanes : kernel.lanes.front();
    return job;
}

/// One render an iteration, its time from the events: the host's clock only where those are of no use.
void time_renders(benchmark::State& state, DeviceBench& bench, const Integrator& kernel) {
    const RenderJob job = job_of(kernel, bench.device().info, static_cast<int>(state.range(0)));
    const auto render = kernel.make(bench.device(), bench.program(kernel, job), bench.scene(), job);
    PassCutter cutter;
    const auto once = [&] {
        return timed_render(*render,
                            {cutter, bench.device().info.timer_resolution_ns, [](double) { return true; }});
    };
    std::string fault = once().timer.fault;  // the first render warms up: some drivers compile in it
    for (auto _ : state) {
        const TimedRender timed = once();
        if (fault.empty()) fault = timed.timer.fault;
        const bool host = !timed.timer.fault.empty() || timed.time.kernel_ns == 0;
        state.SetIterationTime(static_cast<double>(host ? timed.time.host_ns : timed.time.kernel_ns) * 1e-9);
    }
    const Film film = render->read_film();
    const auto per_second = benchmark::Counter::kIsIterationInvariantRate;
    state.counters["segments/s"] = {static_cast<double>(film.segments), per_second};
    state.counters["samples/s"] = {static_cast<double>(job.size.pixels()) * job.spp, per_second};
    state.SetLabel(fault.empty() ? fmt::format("events, lanes {}", job.lanes)
                                 : fmt::format("host clock ({}), lanes {}", fault, job.lanes));
}

void register_device(const DeviceInfo& info) {
    const auto bench = std::make_shared<DeviceBench>(info.key);
    for (const Integrator& kernel : integrators()) {
        if (!kernel.spheres) continue;
        const auto run = [bench, &kernel](benchmark::State& state) {
            try {
                time_renders(state, *bench, kernel);
            } catch (const std::exception& error) {
                state.SkipWithError(error.what());
            }
        };
        benchmark::RegisterBenchmark(fmt::format("render/{}/{}", info.key, kernel.id).c_str(), run)
            ->ArgName("spp")
            ->Arg(1)
            ->Arg(10)
            ->Arg(100)
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
    }
    benchmark::AddCustomContext(info.key, fmt::format("{}, {}", info.name, info.driver_version));
}

}  // namespace

void register_renders() {
    for (const DeviceInfo& info : ocl::query_devices()) register_device(info);
}

}  // namespace ptb
