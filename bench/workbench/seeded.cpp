#include "bench/workbench/seeded.h"

namespace ptb {

void render_seeds(Builds& builds, Pace& pace, const CaseJob& job, int count, const Progress& progress,
                  const std::function<void(Film)>& take) {
    for (int i = 0; i < count; ++i) {
        CaseJob seeded = job;
        seeded.work.seed += static_cast<std::uint32_t>(i);
        const auto render = builds.make(seeded);
        const auto of_all = [&](double done) { return progress((i + done) / count); };
        timed_render(*render, pace.timing(seeded, of_all));
        take(render->read_film());
    }
}

}  // namespace ptb
