#include "bench/workbench/launch_check.h"

#include <fmt/format.h>

#include "bench/measure/clock.h"
#include "bench/plan/config.h"
#include "bench/validate/validate.h"
#include "bench/workbench/outcome.h"
#include "core/ocl/error.h"

namespace ptb {
namespace {

constexpr Size compared_size{128, 128};
constexpr int compared_spp = 2;
constexpr std::uint64_t short_pass = 5000, long_pass = 1U << 30U;  ///< samples

bool refused_work_group(const ocl::Error& e) {
    return e.code() == CL_INVALID_WORK_GROUP_SIZE || e.code() == CL_OUT_OF_RESOURCES ||
           e.code() == CL_INVALID_WORK_ITEM_SIZE;
}

/// "work-group 64, queue out_of_order"
std::string launch_name(const Case& c) {
    const std::string more = to_string(of_launch(c.variant));
    return "work-group " + to_string(c.work_group) + (more.empty() ? "" : ", " + more);
}

/// Takes the first launch. An error is the work-group's fault where the same work without one has none: a
/// device that is lost refuses that too.
void launch_first(Builds& builds, const CaseJob& job, Render& render, std::uint64_t max_work_group) {
    const std::uint64_t samples = job.work.size.pixels();
    try {
        render.advance(samples);
    } catch (const ocl::Error& e) {
        if (job.params.work_group.implicit() || !refused_work_group(e)) throw;
        builds.make(job.plain())->advance(samples);
        throw Unsupported(fmt::format("work_group {}: this kernel allows {} work-items here ({})",
                                      to_string(job.params.work_group), max_work_group,
                                      ocl::error_name(e.code())));
    }
}

void render_all(Render& render, std::uint64_t samples_a_pass) {
    render.restart();
    while (render.samples_left() > 0) render.advance(samples_a_pass);
}

}  // namespace

void check_launch(Builds& builds, const CaseJob& job, Record& record) {
    const CaseJob small = job.sized(compared_size, compared_spp);
    const auto launched = builds.make(small);
    const std::int64_t begin = now_ns();
    launch_first(builds, small, *launched, record.build->max_work_group);
    record.build->first_launch_ns = now_ns() - begin;
    render_all(*launched, short_pass);
    const auto usual = builds.make(small.plain());
    render_all(*usual, long_pass);
    check_same_bits(*record.validation, usual->read_film(), launched->read_film(), launch_name(job.params));
}

}  // namespace ptb
