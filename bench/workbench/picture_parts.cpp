#include "bench/workbench/picture_parts.h"

#include "bench/measure/clock.h"
#include "bench/workbench/outcome.h"

namespace ptb {
namespace {

std::unique_ptr<PartRender> make_parts(Builds& builds, const CaseJob& job) {
    if (const std::string reason = job.kernel->parts_refusal(); !reason.empty()) throw Unsupported(reason);
    return builds.make_parts(job);
}

}  // namespace

PictureParts::PictureParts(Builds& builds, Pace& pace, const CaseJob& job)
    : pace_(pace), job_(job), render_(make_parts(builds, job)) {}

PartsDone PictureParts::render(PartRange parts, const Progress& progress) {
    const std::int64_t begin = now_ns();
    render_->take(parts);
    const TimedRender timed = timed_rest(*render_, pace_.timing(job_, progress));
    return {{parts.first, render_->parts_left().first},
            seconds_since(begin),
            static_cast<double>(timed.time.kernel_ns) * 1e-9};
}

FilmFacts PictureParts::take_film(std::span<FilmPixel> pixels) {
    const FilmFacts facts = render_->read_sums(pixels);
    render_->restart();
    return facts;
}

}  // namespace ptb
