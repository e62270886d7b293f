#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/fleet/screen.h"

namespace ptb {

inline constexpr int confirm_sessions = 5;
inline constexpr std::size_t most_controls = 9;
inline constexpr double confirm_alpha = 0.05;  ///< the chance of any false alarm in a fleet

/// Equal cards that are to stand beside the candidates, at random by `seed`: of nodes that are not suspected,
/// as far as there are any.
std::vector<std::size_t> controls_of(const Screened& screened, const std::vector<std::string>& node_of_card,
                                     std::uint64_t seed);

/// How much slower a candidate was in each session than the controls were in all: medians over works of log
/// time less the controls' median.
std::vector<double> session_deviations(const LogTimes& candidate, const LogTimes& controls);

enum class Speed { suspect, slow };

/// What becomes of a candidate.
struct Confirmed {
    Speed speed = Speed::suspect;
    double mean = 0;      ///< of its deviations, log time
    double at_least = 0;  ///< their lower bound, at the level that Holm's procedure gives it
};

/// One for each candidate of a fleet: `suspect` where fewer than two sessions have times, `slow` where the
/// lower bound of its mean (by Student's t) is over 3 %. See "A Simple Sequentially Rejective Multiple Test
/// Procedure", by S. Holm.
std::vector<Confirmed> confirmed(const std::vector<std::vector<double>>& deviations);

}  // namespace ptb
