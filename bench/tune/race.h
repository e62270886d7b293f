#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace ptb {

/// How a race is run.
struct RaceRules {
    double alpha = 0.05;  ///< chance that the best is ever dropped, over all comparisons and looks
    double tie = 0.02;    ///< what is certainly less slower than this is as good as the leader
    std::uint64_t seed = 1;
};

/// Samples at which candidates are compared; after the last one the race is over.
inline constexpr int looks[] = {3, 4, 6, 8, 12, 16, 24, 32, 48, 64};

/// One candidate after a race.
struct Runner {
    enum class State { tied, slower, failed };
    State state = State::tied;
    std::vector<double> times;
    double slower = 0;  ///< than the leader: mean log ratio when last compared
    double bound = 0;   ///< at most so much, at the level of the race
};

struct Race {
    std::vector<Runner> runners;
    std::optional<std::size_t> leader;  ///< none when all failed
    bool settled = false;               ///< every tie is within `RaceRules::tie` of the leader
};

/// A time of one candidate, above 0 and of any unit; nothing when it failed, which takes it out of the race.
using TakeTime = std::function<std::optional<double>(std::size_t candidate)>;

/// Finds the fastest of `candidates`. They are sampled in rounds, shuffled anew, so that drifts and bursts
/// meet all of them; at each look those that a paired t test on log times calls slower than the leader are
/// dropped, at a level of alpha / (looks x pairs with the best). Ends when one is left, when all that are
/// left are as good as the leader, or after the last look. See "Hoeffding Races", by O. Maron and A. Moore.
Race race(std::size_t candidates, const RaceRules& rules, const TakeTime& take);

}  // namespace ptb
