#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace ptb {

/// How an image's samples are cut into runs: its bits depend on it. See core/integrator/runs.h.
struct RunCut {
    std::uint64_t fair = 0;  ///< samples of a run that keep all lanes busy to the end
    std::uint64_t most = 0;  ///< samples of the longest round
    bool operator==(const RunCut&) const = default;
};

/// Parts of an image: a part is what one round of samples gives of one pixel. Numbered by pixels, and round
/// by round. Whoever makes them in whatever order, their films add up to the image's.
struct PartRange {
    std::uint64_t first = 0, end = 0;
    std::uint64_t count() const { return end - first; }
    auto operator<=>(const PartRange&) const = default;
};

inline std::uint64_t count_of(const std::vector<PartRange>& ranges) {
    std::uint64_t sum = 0;
    for (const PartRange& range : ranges) sum += range.count();
    return sum;
}

}  // namespace ptb
