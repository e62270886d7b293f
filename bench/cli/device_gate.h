#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cli/options.h"
#include "bench/worker/paired.h"

namespace ptb {

/// Measures the cases of one device alternately on both sides: validation, screen, and fresh blocks for
/// suspects; says on stderr how far it is.
void measure_pairs(PairedRun& run, const std::string& key, const CommonFlags& flags,
                   std::uint64_t shuffle_seed, std::vector<PairedCase>& cases);

}  // namespace ptb
