#pragma once

#include <optional>

#include "bench/record/record.h"
#include "bench/workbench/case_job.h"
#include "core/oracle/reference.h"

namespace ptb {

/// How efficient a timed case was, by the noise of its image; or why that cannot be told.
Efficiency efficiency_of(const CaseJob& job, const Film& film, const Statistics& statistics,
                         const std::optional<Reference>& reference);

}  // namespace ptb
