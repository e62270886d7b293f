#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/tune/race.h"
#include "bench/worker/coordinator.h"

namespace ptb {

/// Candidates of one device, and what became of them.
struct Contest {
    std::vector<Record> records;     ///< of the validation, one a candidate
    std::vector<std::size_t> raced;  ///< candidates with a valid image: runner i is candidate raced[i]
    std::string timer = "event";     ///< or "host", where most candidates' event times are not believed
    Race race;                       ///< times in ns
    bool valid(std::size_t candidate) const;
};

/// Validates every candidate, and races those whose images are valid. Ends early, with nothing to be used,
/// when `stopped`. `tell` hears of the stages.
Contest hold_contest(DeviceWorker& worker, const std::vector<Case>& candidates, const RaceRules& rules,
                     const Stopped& stopped, const std::function<void(const std::string&)>& tell);

}  // namespace ptb
