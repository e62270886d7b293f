#include "bench/workbench/workbench.h"

#include <utility>

#include "bench/measure/clock.h"
#include "bench/measure/peaks.h"
#include "bench/plan/scene_file.h"
#include "bench/workbench/counting.h"
#include "bench/workbench/efficiency.h"
#include "bench/workbench/launch_check.h"
#include "bench/workbench/outcome.h"

namespace ptb {
namespace {

void refuse_unsupported(const CaseJob& job, const ocl::Device& device) {
    const std::string unsupported = unsupported_reason(*job.kernel, device, *job.scene, job.work);
    if (!unsupported.empty()) throw Unsupported(unsupported);
}

std::unique_ptr<Render> upload(Builds& builds, const CaseJob& job, Record& record) {
    const std::int64_t begin = now_ns();
    auto render = builds.make(job);
    record.build->upload_ms = seconds_since(begin) * 1e3;
    record.work = Work{};
    record.work->samples = job.work.size.pixels() * static_cast<std::uint64_t>(job.work.spp);
    record.work->lanes = job.work.lanes;
    record.work->device_bytes = render->device_bytes();
    return render;
}

Film read_back(Render& render, Record& record) {
    const std::int64_t begin = now_ns();
    Film film = render.read_film();
    record.build->readback_ms = seconds_since(begin) * 1e3;
    record.work->segments = film.segments;
    record.work->shadow_rays = film.shadow_rays;
    record.work->light_segments = film.light_segments;
    record.work->full_length_paths = film.full_length_paths.value_or(0);
    record.work->film_hash = film.hash;
    if (film.rays) record.work->listed_rays = film.segments;
    return film;
}

}  // namespace

Workbench::Workbench(const std::string& device_key, const MeasureOptions& options,
                     const std::filesystem::path& data_folder)
    : options_(options),
      data_folder_(data_folder),
      builds_(ocl::open_device(device_key), options.kernel_dir),
      pace_(builds_),
      validator_(builds_, pace_, data_folder / "results" / "references", options.seed),
      stopwatch_(builds_, pace_, options) {}

CaseJob Workbench::resolve(const Case& params) {
    const Integrator& kernel = integrator(params.kernel);
    auto found = scenes_.find(params.scene);
    if (found == scenes_.end())
        found = scenes_.emplace(params.scene, load_scene(scene_file(params.scene, data_folder_))).first;
    CaseJob job{params, &found->second, &kernel,
                render_job(params, kernel, builds_.device().info, found->second, options_.seed)};
    trees_.of(job, builds_.device());
    return job;
}

CaseResult Workbench::run(const Case& params, const RunHow& how, const Stage& stage) {
    CaseResult result;
    result.record.params = params;
    conclude_attempt(result.record, [&] {
        if (!options_.skip_time) stopwatch_.rest(stage);
        attempt(resolve(params), how, stage, result);
    });
    return result;
}

void Workbench::attempt(const CaseJob& job, const RunHow& how, const Stage& stage, CaseResult& result) {
    Record& record = result.record;
    refuse_unsupported(job, builds_.device());
    stage("build", 0);
    record.tree = trees_.of(job, builds_.device());
    record.build = builds_.source_of(job);
    record.build = builds_.described(job);
    record.validation = validator_.verdict(job, stage);
    if (record.validation->valid) check_launch(builds_, job, record);
    if (record.validation->valid && !options_.skip_time && !how.validate_only)
        result.picture = time(job, how, stage, record);
    conclude_by_image(record);
    if (!options_.count || !record.statistics) return;
    const double ns_per_sample = record.statistics->median_ns / static_cast<double>(record.work->samples);
    record.counted = count_work(builds_, job, ns_per_sample, stage);
}

Image Workbench::time(const CaseJob& job, const RunHow& how, const Stage& stage, Record& record) {
    const auto render = upload(builds_, job, record);
    const Measurement measurement = stopwatch_.time(job, *render, how.time_left_s, stage, record);
    if (how.others_measure) stage("beside", 0);
    while (how.others_measure && how.others_measure())
        timed_render(*render, pace_.timing(job, passes(stage, "beside")));
    Film film = read_back(*render, record);
    validator_.check_timed_film(job, film, *record.validation);
    stopwatch_.summarize(measurement, record);
    if (record.statistics)
        record.efficiency = efficiency_of(builds_, pace_, job, film, *record.statistics,
                                          validator_.stored_reference(job), stage);
    return std::move(film.mean);
}

Record Workbench::round(const Case& params, int samples, const Stage& stage) {
    const CaseJob job = resolve(params);
    Record record;
    record.params = params;
    record.validation = validator_.verdict(job, stage);
    const auto render = builds_.make(job);
    for (int i = 0; i < samples; ++i)
        record.samples.push_back(timed_render(*render, pace_.timing(job, passes(stage, "sample"))).time);
    validator_.check_timed_film(job, render->read_film(), *record.validation);
    conclude_by_image(record);
    return record;
}

Rendered Workbench::picture(const Case& params, Aov aov, std::optional<double> time_s,
                            const Progress& progress) {
    CaseJob job = resolve(params);
    job.work.aov = aov;
    refuse_unsupported(job, builds_.device());
    return render_picture(builds_, pace_, job, time_s, progress);
}

std::unique_ptr<PictureParts> Workbench::parts(const Case& params, const std::optional<RunCut>& cut) {
    CaseJob job = resolve(params);
    job.work.cut = cut;
    refuse_unsupported(job, builds_.device());
    return std::make_unique<PictureParts>(builds_, pace_, job);
}

std::vector<Peak> Workbench::peaks(const Stage& stage) const {
    return measure_peaks(builds_.device(), options_.timer, options_.kernel_dir,
                         [&](const std::string& name) { stage("peak " + name, 0); });
}

double Workbench::estimate(const Case& params) {
    const CaseJob job = resolve(params);
    refuse_unsupported(job, builds_.device());
    return pace_.ns_per_sample(job);
}

}  // namespace ptb
