#pragma once

#include <optional>

#include "bench/record/record.h"
#include "bench/workbench/pace.h"
#include "bench/workbench/stage.h"
#include "core/oracle/reference.h"

namespace ptb {

/// How efficient a timed case was, by the noise of its image; or why that cannot be told. Where pixels share
/// paths that takes further renders, in all of about as many samples as the image has. Throws what goes wrong
/// in them.
Efficiency efficiency_of(Builds& builds, Pace& pace, const CaseJob& job, const Film& film,
                         const Statistics& statistics, const std::optional<Reference>& reference,
                         const Stage& stage);

}  // namespace ptb
