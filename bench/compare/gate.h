#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/compare/verdict.h"
#include "bench/plan/case.h"

namespace ptb {

/// The plan of a gate: how many blocks are enough to suspect, and how many fresh ones to convict.
inline constexpr int screen_blocks = 10;
inline constexpr int confirm_blocks = 20;
inline constexpr int round_samples = 3;
inline constexpr double suspect_p = 0.10;

/// Times of `round_samples` renders of one case on one side, both clocks, ns.
struct Round {
    std::vector<std::int64_t> kernel_ns, host_ns;
    bool operator==(const Round&) const = default;
};

/// Base, new, new, base: a drift that is linear in time cancels.
struct Block {
    std::vector<Round> rounds;
    bool operator==(const Block&) const = default;
};

/// One case of a gate with its data. Work only adds to a time, so a round counts as its shortest sample.
struct GateCase {
    Case base, now;     ///< equal but where two configs are compared
    std::string timer;  ///< "event" or "host": the clock that both sides are judged by
    double tolerance = 0.05;
    std::string not_measured;                 ///< why there are no blocks, or empty
    State without_times = State::unmeasured;  ///< what it is called then
    std::vector<Block> screen, confirm;
    bool operator==(const GateCase&) const = default;
};

/// ln(new) - ln(base) of each block.
std::vector<double> differences(std::span<const Block> blocks, const std::string& timer);

/// Whether a screened case is worth fresh blocks: p below `suspect_p`, and a shift over half of the
/// tolerance.
bool suspect(const GateCase& c);

/// Judges all cases of a gate: suspects by their fresh blocks alone, corrected by Holm among themselves; the
/// others by the screen, where nothing can be called changed.
std::vector<Finding> decide(std::span<const GateCase> cases);

}  // namespace ptb
