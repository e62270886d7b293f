#pragma once

#include "bench/workbench/builds.h"
#include "bench/workbench/stage.h"

namespace ptb {

/// What a job's kernel does, by one pass of an instrumented build of it that lasts as long as the timed work
/// would. What goes wrong is a reason.
Counted count_work(Builds& builds, const CaseJob& job, double ns_per_sample, const Stage& stage);

}  // namespace ptb
