#include "bench/workbench/counting.h"

#include <algorithm>

#include "bench/measure/counted.h"

namespace ptb {
namespace {

constexpr double counted_ns = 0.25e9;  ///< of a case's work: about a pass

}  // namespace

Counted count_work(Builds& builds, const CaseJob& job, double ns_per_sample, const Stage& stage) {
    stage("count", 0);
    Counted none;
    try {
        const auto render = builds.make_counting(job);
        render->advance(static_cast<std::uint64_t>(std::max(counted_ns / ns_per_sample, 1.0)));
        if (const auto counts = render->counts()) return counted_of(*counts, render->read_film().segments);
        none.reason = "this kernel does not count";
    } catch (const std::exception& e) {
        none.reason = e.what();
    }
    return none;
}

}  // namespace ptb
