#pragma once

#include <functional>
#include <string>

#include "bench/workbench/pace.h"
#include "bench/workbench/stage.h"

namespace ptb {

/// Renders a job so many times, which differ in their seeds alone; `take` gets the films. Throws what goes
/// wrong.
void render_seeds(Builds& builds, Pace& pace, const CaseJob& job, int count, const Progress& progress,
                  const std::function<void(Film)>& take);

}  // namespace ptb
