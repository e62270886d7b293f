#pragma once

#include <string>
#include <vector>

#include "bench/worker/forecast.h"

namespace ptb {

/// One line a case, its predicted time last where it is known: what --dry-run prints.
std::string plan_text(const std::vector<Case>& cases, const Forecast& forecast);

}  // namespace ptb
