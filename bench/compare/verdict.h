#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/compare/shift.h"

namespace ptb {

/// What is said of one case of two versions.
enum class State {
    regressed,
    improved,
    same,
    inconclusive,
    missing,    ///< the base has a time, the new side has none
    unmeasured  ///< neither side has a time
};
std::string to_string(State state);
std::optional<State> parse_state(std::string_view text);

/// A case that the new side is slower on is called regressed only under this p, after Holm.
inline constexpr double significant_p = 0.01;
inline constexpr double interval_confidence = 0.95;

/// The numbers behind a state. `shift` is of log time.
struct Evidence {
    Shift shift;
    double p = 1;               ///< as tested, two-sided
    double holm_p = 1;          ///< as corrected for the other cases
    double standard_error = 0;  ///< of the log ratio
    double ratio() const;       ///< new time / base time
    bool operator==(const Evidence&) const = default;
};

/// What was found of one case.
struct Finding {
    State state = State::inconclusive;
    Evidence evidence;
    double base_ns = 0, now_ns = 0;  ///< medians
    double smallest_effect = 0;      ///< a ratio less 1
    int n = 0;                       ///< blocks, or values of the side that has fewer
    bool operator==(const Finding&) const = default;
};

/// regressed iff significant and the ratio is at least 1 + tolerance; improved by the mirror rule; same iff
/// the ratio's whole interval lies in [1/(1 + tolerance), 1 + tolerance]; else inconclusive.
State judge(const Evidence& evidence, double tolerance);

}  // namespace ptb
