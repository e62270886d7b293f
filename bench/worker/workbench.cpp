#include "bench/worker/workbench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include <fmt/format.h>

#include "bench/measure/clock.h"
#include "bench/measure/counted.h"
#include "bench/measure/peaks.h"
#include "bench/plan/scene_file.h"
#include "bench/validate/validate.h"
#include "core/image/image_io.h"
#include "core/oracle/oracle.h"

namespace ptb {

namespace {

constexpr double validation_s = 15;  ///< a slow device validates on the samples that this time gives
constexpr Size probe_size{128, 128};
constexpr int probe_spp = 2;        ///< of the small renders that are compared by their bits
constexpr double counted_s = 0.25;  ///< of a case's work that is counted: about a pass

/// Samples a pixel of the validation, by the kernel's speed.
int validation_spp(double ns_per_sample) {
    const double pixels = static_cast<double>(validation_size.pixels());
    const double by_time = validation_s * 1e9 / std::max(ns_per_sample, 1e-3);
    return static_cast<int>(std::clamp(by_time, 4 * pixels, static_cast<double>(validation_samples)) /
                            pixels);
}

bool has_roulette(const RenderJob& job) { return job.variant.roulette != Roulette::off; }

bool refused_work_group(const ocl::Error& e) {
    return e.code() == CL_INVALID_WORK_GROUP_SIZE || e.code() == CL_OUT_OF_RESOURCES ||
           e.code() == CL_INVALID_WORK_ITEM_SIZE;
}

/// Reports passes under a stage's name.
Progress stage(const Workbench::Stage& progress, const std::string& name) {
    return [&progress, name](double done) {
        progress(name, done);
        return true;
    };
}

/// Asked work that this device or kernel refuses; `what()` names the limit.
struct Unsupported : std::runtime_error {
    using std::runtime_error::runtime_error;
};

Build describe_build(const BuiltKernel& kernel, const ocl::KernelFacts& facts) {
    Build build;
    build.options = kernel.program.options;
    build.kernel_hash = kernel.program.kernel_hash;
    build.overridden = kernel.program.overridden;
    build.log = kernel.program.log;
    build.build_ms = kernel.build_ms;
    build.max_work_group = facts.max_work_group;
    build.preferred_multiple = facts.preferred_multiple;
    build.local_bytes = facts.local_bytes;
    build.private_bytes = facts.private_bytes;
    build.binary_bytes = facts.binary_bytes;
    build.registers = facts.log.registers;
    build.spill_store_bytes = facts.log.spill_store_bytes;
    build.spill_load_bytes = facts.log.spill_load_bytes;
    return build;
}

/// "work-group 64, queue out_of_order"
std::string launch_name(const Case& c) {
    const std::string more = to_string(of_launch(c.variant));
    return "work-group " + to_string(c.work_group) + (more.empty() ? "" : ", " + more);
}

/// Share of the launches' own times that ran beside another's, over all samples.
std::optional<double> overlap_of(const std::vector<TimeSample>& samples) {
    double sum_ns = 0, union_ns = 0;
    for (const TimeSample& sample : samples) {
        sum_ns += static_cast<double>(sample.sum_ns);
        union_ns += static_cast<double>(sample.kernel_ns);
    }
    return sum_ns > 0 ? std::optional(std::max(0.0, 1 - union_ns / sum_ns)) : std::nullopt;
}

double steady_s() { return seconds_since(0); }

/// Waits, and says so.
std::function<void(double s)> waiting(const Workbench::Stage& progress) {
    return [&progress](double s) {
        for (const std::int64_t begin = now_ns(); seconds_since(begin) < s;) {
            progress("idle", seconds_since(begin) / s);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    };
}

void conclude(Record& record, Status status, const std::string& reason) {
    record.status = status;
    record.reason = reason;
    if (status == Status::ok || status == Status::unstable) return;
    record.samples.clear();
    record.statistics.reset();
    record.energy.reset();
    record.counted.reset();
    if (record.work) record.work->longest_launch_ns = 0;
    if (record.build) record.build->first_launch_ns = 0;
}

}  // namespace

struct Workbench::Job {
    Case params;
    const Scene* scene = nullptr;
    const Integrator* kernel = nullptr;
    RenderJob work;
    std::string key_of(const Variant& variant) const {
        return fmt::format("{} {} {} {} {}", params.kernel, params.scene, work.lanes, work.path_length,
                           to_string(variant));
    }
    /// What a pixel sample costs depends on.
    std::string key() const { return key_of(work.variant); }
    /// What it is worth.
    std::string image_key() const { return key_of(of_image(work.variant)); }
    /// The same work, launched as usual.
    RenderJob plain() const {
        RenderJob job = work;
        job.work_group_x = job.work_group_y = 0;
        job.variant = of_image(work.variant);
        return job;
    }
};

Workbench::Workbench(const std::string& device_key, const MeasureOptions& options,
                     std::filesystem::path data_folder)
    : device_(ocl::open_device(device_key)),
      options_(options),
      data_folder_(std::move(data_folder)),
      timer_(options.timer),
      disturbances_(device_) {}

const Scene& Workbench::scene(const std::string& name) {
    const auto found = scenes_.find(name);
    if (found != scenes_.end()) return found->second;
    return scenes_[name] = load_scene(scene_file(name, data_folder_));
}

Workbench::Job Workbench::resolve(const Case& params) {
    Job job{params, &scene(params.scene), &integrator(params.kernel), {}};
    job.work = {params.size,
                params.spp,
                params.path_length,
                static_cast<std::uint32_t>(options_.seed),
                params.lanes == 0 ? default_lanes(*job.kernel, device_.info) : params.lanes,
                params.work_group.x,
                params.work_group.y,
                params.variant};
    return job;
}

/// What is known of a build before it succeeds.
Build Workbench::describe_source(const Job& job) const {
    const KernelSource source = kernel_source(job.kernel->file(), options_.kernel_dir);
    Build build;
    build.options = job.kernel->options(device_, *job.scene, job.work);
    build.kernel_hash = source.hash;
    build.overridden = source.overridden;
    return build;
}

std::unique_ptr<Render> Workbench::make(const Job& job, const RenderJob& work) {
    return job.kernel->make(device_, built(job, work).program, *job.scene, work);
}

const BuiltKernel& Workbench::built(const Job& job, const RenderJob& work) {
    const std::string options = job.kernel->options(device_, *job.scene, work);
    const std::string key = job.params.kernel + " " + options;
    const auto found = built_.find(key);
    if (found != built_.end()) return found->second;
    const KernelSource source = kernel_source(job.kernel->file(), options_.kernel_dir);
    const std::int64_t begin = now_ns();
    BuiltKernel fresh{ocl::build(device_, source, options), 0};
    fresh.build_ms = seconds_since(begin) * 1e3;
    return built_[key] = fresh;
}

double Workbench::estimate(const Case& params) {
    const Job job = resolve(params);
    double& ns_per_sample = ns_per_sample_[job.key()];
    if (ns_per_sample > 0) return ns_per_sample;
    RenderJob work = job.work;
    work.size = probe_size;
    work.spp = probe_spp;
    work.work_group_x = work.work_group_y = 0;
    const auto render = make(job, work);
    PassCutter& cutter = cutters_[job.key()];
    std::int64_t ns = 0;
    for (int i = 0; i < 2; ++i) {  // the first render may compile
        const TimedRender timed =
            timed_render(*render, {cutter, device_.info.timer_resolution_ns, [](double) { return true; }});
        ns = timed.timer.fault.empty() ? timed.time.kernel_ns : timed.time.host_ns;
    }
    return ns_per_sample = static_cast<double>(ns) / static_cast<double>(work.size.pixels() * probe_spp);
}

std::optional<Reference> Workbench::stored_reference(const Job& job) const {
    if (job.work.variant.pixel_filter == PixelFilter::centre) return std::nullopt;  // theirs is another image
    return load_reference(
        data_folder_ / "results" / "references",
        reference_name(job.scene->name, truth_of(job.params.kernel), validation_size, job.work.path_length));
}

/// A few samples of the host's own tracer, for work that has no stored reference.
Reference Workbench::host_reference(const Job& job) const {
    const Tracer trace = tracers().at(truth_of(job.params.kernel));
    OracleJob work;
    work.size = {32, 32};
    work.spp = 4;
    work.path_length = job.work.path_length;
    work.seed = options_.seed + 1;
    work.threads = 2;
    work.pixel_centres = job.work.variant.pixel_filter == PixelFilter::centre;
    if (work.pixel_centres) work.size = validation_size;  // other pixels have other centres
    const std::int64_t begin = now_ns();
    OracleResult result = trace(*job.scene, work);
    work.spp =
        static_cast<int>(std::clamp(2.0 / std::max(seconds_since(begin), 1e-3) * work.spp, 4.0, 4000.0));
    result = trace(*job.scene, work);
    Reference reference;
    reference.size = work.size;
    reference.spp = work.spp;
    reference.segments_per_sample =
        static_cast<double>(result.segments) / static_cast<double>(result.samples);
    reference.segments_variance = result.segments_variance;
    reference.full_length_share =
        static_cast<double>(result.full_length_paths) / static_cast<double>(result.samples);
    reference.mean = std::move(result.mean);
    reference.variance = std::move(result.variance);
    return reference;
}

const Validation& Workbench::validated(const Job& job, const Stage& progress) {
    const auto found = validations_.find(job.image_key());
    if (found != validations_.end()) return found->second;
    RenderJob work = job.plain();
    work.size = validation_size;
    const std::optional<Reference> reference = stored_reference(job);
    Case plain = job.params;
    plain.variant = work.variant;
    work.spp = validation_spp(estimate(plain));
    if (!reference) work.spp = std::min(work.spp, 64);
    const auto render = make(job, work);
    timed_render(*render,
                 {cutters_[job.image_key()], device_.info.timer_resolution_ns, stage(progress, "validate")});
    const Film film = render->read_film();
    const FilmEvidence evidence{film, work.size, work.spp, work.path_length, has_roulette(work)};
    Validation validation = check_film(evidence);
    if (reference)
        check_against(validation, evidence, *reference);
    else
        check_timed(validation, evidence, host_reference(job));
    validation.against = reference ? reference_name(reference->scene, reference->kernel, reference->size,
                                                    reference->path_length)
                                   : "the host's tracer, a few samples (there is no stored reference)";
    return validations_[job.image_key()] = validation;
}

/// The same small work twice, once as the case launches it and in other passes, must give the same bits.
/// Takes the first launch of this work-group size, which may compile.
void Workbench::check_launch(const Job& job, Record& record) {
    RenderJob work = job.work;
    RenderJob usual = job.plain();
    usual.size = work.size = probe_size;
    usual.spp = probe_spp;
    work.spp = probe_spp;
    const auto launched = make(job, work);
    const std::int64_t begin = now_ns();
    try {
        launched->advance(work.size.pixels());
    } catch (const ocl::Error& e) {
        if (job.params.work_group.implicit() || !refused_work_group(e)) throw;
        make(job, usual)->advance(work.size.pixels());  // a device that is lost refuses this too
        throw Unsupported(fmt::format("work_group {}: this kernel allows {} work-items here ({})",
                                      to_string(job.params.work_group), record.build->max_work_group,
                                      ocl::error_name(e.code())));
    }
    record.build->first_launch_ns = now_ns() - begin;
    launched->restart();
    while (launched->samples_left() > 0) launched->advance(5000);
    const auto plain = make(job, usual);
    while (plain->samples_left() > 0) plain->advance(1u << 30);
    check_same_bits(*record.validation, plain->read_film(), launched->read_film(), launch_name(job.params));
}

/// Times the case's own work by the method of bench/measure. Leaves the last sample's film in `render`.
Measurement Workbench::take_samples(const Job& job, Render& render, double time_left_s, const Stage& progress,
                                    Record& record) {
    const double render_s = estimate(job.params) * static_cast<double>(record.work->samples) * 1e-9;
    bool timing = false;
    const auto take = [&](const std::string& name, int renders) {
        if (!timing) energy_->restart();
        timing = name == "sample";
        disturbances_.begin(render_s * renders);
        TimedRender timed = timed_render(
            render, {cutters_[job.key()], device_.info.timer_resolution_ns, stage(progress, name), renders});
        energy_->add(renders);
        disturbances_.end(timed.time);
        record.work->passes = timed.passes;
        record.work->longest_launch_ns = std::max(record.work->longest_launch_ns, timed.longest_launch_ns);
        return timed;
    };
    timer_.restart();
    const Method method{{options_.min_samples, options_.max_samples, options_.max_time_s, time_left_s},
                        options_.warmup,
                        render_s,
                        device_.info.timer_resolution_ns};
    const std::int64_t begin = now_ns();
    return ptb::measure(method, timer_, take, [begin] { return seconds_since(begin); });
}

/// Notes what was measured; an unstable case keeps its numbers, and says so.
void Workbench::summarize(const Measurement& measurement, Record& record) const {
    record.samples = measurement.samples;
    record.work->renders = measurement.renders;
    if (record.params.variant.queue == QueueOrder::out_of_order)
        record.work->overlap = overlap_of(measurement.samples);
    Statistics statistics = describe(measurement, timer_);
    const std::string unstable = unstable_reason(measurement, timer_, disturbances_.place());
    if (!unstable.empty()) conclude(record, Status::unstable, unstable);
    if (statistics.median_ns <= 0) return;
    statistics.msamples_per_s = static_cast<double>(record.work->samples) / statistics.median_ns * 1e3;
    statistics.msegments_per_s = static_cast<double>(record.work->segments) / statistics.median_ns * 1e3;
    record.statistics = statistics;
}

/// The timed render's own picture must pass what any picture of this work must.
void Workbench::check_film_of(const Job& job, const Film& film, Validation& validation) const {
    const FilmEvidence evidence{film, job.work.size, job.work.spp, job.work.path_length,
                                has_roulette(job.work)};
    Validation own = check_film(evidence);
    if (const auto reference = stored_reference(job)) check_timed(own, evidence, *reference);
    validation.checks.emplace_back("timed image");
    if (!own.valid) fail(validation, "the timed image: " + own.reason);
}

void Workbench::measure(const Job& job, double time_left_s, const std::string& image_file,
                        const Stage& progress, Record& record) {
    const std::int64_t uploading = now_ns();
    const auto render = make(job, job.work);
    record.build->upload_ms = seconds_since(uploading) * 1e3;
    record.work = Work{};
    record.work->samples = job.work.size.pixels() * static_cast<std::uint64_t>(job.work.spp);
    record.work->lanes = job.work.lanes;
    record.work->device_bytes = render->device_bytes();
    const Measurement measurement = take_samples(job, *render, time_left_s, progress, record);
    if (options_.timer == "event" && !timer_.fault().empty())
        throw Unsupported(fmt::format("--timer event: {}; auto takes the host's clock then", timer_.fault()));

    record.energy = energy_->spent(record.work->samples);
    const std::int64_t reading = now_ns();
    const Film film = render->read_film();
    record.build->readback_ms = seconds_since(reading) * 1e3;
    record.work->segments = film.segments;
    record.work->full_length_paths = film.full_length_paths.value_or(0);
    check_film_of(job, film, *record.validation);
    summarize(measurement, record);
    if (!image_file.empty()) write_image(image_file, film.mean);
}

/// One pass of the case's work by an instrumented build of its kernel. What goes wrong is a reason.
Counted Workbench::counted(const Job& job, const Record& record, const Stage& progress) {
    Counted none;
    progress("count", 0);
    try {
        const std::string options = built(job, job.work).program.options + count_option;
        const std::string key = job.params.kernel + options;
        auto found = counting_.find(key);
        if (found == counting_.end()) {
            const KernelSource source = kernel_source(job.kernel->file(), options_.kernel_dir);
            found = counting_.emplace(key, ocl::build(device_, source, options)).first;
        }
        const double ns_per_sample = record.statistics->median_ns / static_cast<double>(record.work->samples);
        const auto render = job.kernel->make(device_, found->second, *job.scene, job.work);
        render->advance(static_cast<std::uint64_t>(std::max(counted_s * 1e9 / ns_per_sample, 1.0)));
        if (const auto counts = render->counts()) return counted_of(*counts, render->read_film().segments);
        none.reason = "this kernel does not count";
    } catch (const std::exception& e) {
        none.reason = e.what();
    }
    return none;
}

void Workbench::attempt(const Job& job, double time_left_s, const std::string& image_file,
                        const Stage& progress, Record& record) {
    const std::string unsupported = unsupported_reason(*job.kernel, device_, *job.scene, job.work);
    if (!unsupported.empty()) throw Unsupported(unsupported);
    progress("build", 0);
    record.build = describe_source(job);
    RenderJob one_pixel = job.work;
    one_pixel.size = {1, 1};
    one_pixel.spp = 1;
    const BuiltKernel& kernel = built(job, one_pixel);
    record.build = describe_build(kernel, make(job, one_pixel)->facts());
    record.validation = validated(job, progress);
    if (record.validation->valid) check_launch(job, record);
    if (record.validation->valid && !options_.skip_time)
        measure(job, time_left_s, image_file, progress, record);
    if (!record.validation->valid)
        conclude(record, Status::invalid, record.validation->reason);
    else if (record.status != Status::unstable)
        conclude(record, Status::ok, "");
    if (options_.count && record.statistics) record.counted = counted(job, record, progress);
}

Record Workbench::run(const Case& params, double time_left_s, const std::string& image_file,
                      const Stage& progress) {
    Record record;
    record.params = params;
    try {
        if (!energy_ && !options_.skip_time)
            energy_.emplace(energy_counter(device_.info), steady_s, waiting(progress));
        attempt(resolve(params), time_left_s, image_file, progress, record);
    } catch (const Unsupported& e) {
        conclude(record, Status::unsupported, e.what());
    } catch (const ocl::BuildError& e) {
        record.build->log = e.log();
        conclude(record, Status::compile, e.what());
    } catch (const SourceError& e) {
        record.build = Build{};
        record.build->overridden = true;  // the embedded kernels are whole
        conclude(record, Status::compile, e.what());
    } catch (const std::exception& e) {
        conclude(record, Status::runtime, e.what());
    }
    return record;
}

std::vector<Peak> Workbench::peaks(const Stage& progress) const {
    return measure_peaks(device_, options_.timer, options_.kernel_dir,
                         [&](const std::string& name) { progress("peak " + name, 0); });
}

Record Workbench::round(const Case& params, int samples, const Stage& progress) {
    const Job job = resolve(params);
    Record record;
    record.params = params;
    record.validation = validated(job, progress);
    const auto render = make(job, job.work);
    for (int i = 0; i < samples; ++i)
        record.samples.push_back(timed_render(*render, {cutters_[job.key()], device_.info.timer_resolution_ns,
                                                        stage(progress, "sample")})
                                     .time);
    check_film_of(job, render->read_film(), *record.validation);
    const bool valid = record.validation->valid;
    conclude(record, valid ? Status::ok : Status::invalid, record.validation->reason);
    return record;
}

}  // namespace ptb
