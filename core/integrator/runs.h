#pragma once

#include <cstdint>
#include <vector>

namespace ptb {

/// A pixel's samples cut into runs, the engine's units of work. They come in rounds of ever shorter ones: few
/// units cost little, and those at the end of a launch have to be short, or most lanes wait for the last
/// ones. A round that is short enough as a whole is one run.
struct Runs {
    std::vector<std::uint32_t> starts;  ///< first sample of every run, and the end of the last one
    std::vector<std::uint32_t> rounds;  ///< number of every round's first run, and of all runs

    std::uint32_t count() const { return static_cast<std::uint32_t>(starts.size() - 1); }
    std::uint32_t length(std::uint32_t run) const { return starts[run + 1] - starts[run]; }
    std::uint32_t longest() const;
    bool ends_round(std::uint32_t run) const;
    std::uint32_t round_count() const { return static_cast<std::uint32_t>(rounds.size() - 1); }
    /// Samples before a round, which may be the one behind the last.
    std::uint32_t samples_before(std::uint32_t round) const { return starts[rounds[round]]; }
};

/// @param fair  samples of a unit that keep all lanes busy to the end, at least 1
/// @param most  samples of the longest round
Runs make_runs(std::uint32_t spp, std::uint64_t fair, std::uint64_t most);

}  // namespace ptb
