#pragma once

#include <map>
#include <string>

#include "bench/measure/sampler.h"
#include "bench/workbench/builds.h"

namespace ptb {

/// How fast pixel samples come on one device, learned from its renders: the time that one takes, and how many
/// make a pass.
class Pace {
  public:
    explicit Pace(Builds& builds) : builds_(builds) {}

    /// Device time of one pixel sample of a job, from a small render of it. Throws what goes wrong.
    double ns_per_sample(const CaseJob& job);

    /// How to render a job, in passes cut by what is known of its key.
    Timing timing(const CaseJob& job, Progress progress, int renders = 1);

  private:
    std::int64_t trial_ns(const CaseJob& job);

    Builds& builds_;
    std::map<std::string, PassCutter> cutters_;    ///< by `CaseJob::key`
    std::map<std::string, double> ns_per_sample_;  ///< likewise
};

}  // namespace ptb
