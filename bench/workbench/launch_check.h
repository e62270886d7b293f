#pragma once

#include "bench/workbench/builds.h"

namespace ptb {

/// The same small work twice, once as the case launches it and in other passes, must give the same bits: else
/// the record's validation fails. Takes and notes the first launch of this work-group size, which may
/// compile. Throws Unsupported when the device refuses the work-group.
void check_launch(Builds& builds, const CaseJob& job, Record& record);

}  // namespace ptb
