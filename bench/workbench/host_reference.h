#pragma once

#include <cstdint>

#include "bench/workbench/case_job.h"
#include "core/oracle/reference.h"

namespace ptb {

/// Some seconds of the host's own tracer, for work that has no stored reference.
Reference host_reference(const CaseJob& job, std::uint64_t seed);

}  // namespace ptb
