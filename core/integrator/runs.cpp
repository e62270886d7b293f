#include "core/integrator/runs.h"

#include <algorithm>

namespace ptb {

std::uint32_t Runs::longest() const {
    std::uint32_t most = 0;
    for (std::uint32_t run = 0; run < count(); ++run) most = std::max(most, length(run));
    return most;
}

bool Runs::ends_round(std::uint32_t run) const {
    return std::binary_search(rounds.begin(), rounds.end(), run + 1);
}

Runs make_runs(std::uint32_t spp, std::uint64_t fair, std::uint64_t most) {
    const std::uint64_t round = std::clamp<std::uint64_t>(fair > 1 ? 4 * fair : 1, 1, most);
    const std::uint64_t rounds = (spp + round - 1) / round;
    // The last run of a whole round has fair / 5 samples: a round that is no longer is not cut.
    const bool cut = 5 * (spp / rounds) > fair;
    Runs runs{{0}, {0}};
    for (std::uint64_t i = 0; i < rounds; ++i) {
        const std::uint64_t first = spp * i / rounds, samples = spp * (i + 1) / rounds - first;
        for (const std::uint64_t percent : {75u, 95u, 100u}) {
            const auto end = static_cast<std::uint32_t>(first + samples * percent / 100);
            if (end > runs.starts.back() && (cut || percent == 100)) runs.starts.push_back(end);
        }
        runs.rounds.push_back(runs.count());
    }
    return runs;
}

}  // namespace ptb
