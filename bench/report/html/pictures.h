#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/record/record.h"
#include "core/oracle/reference.h"

namespace ptb {

/// A picture of the page and what is said of it; where there is none, `webp` is empty and `caption` says why.
struct Figure {
    std::string caption, webp;
    std::string group{};  ///< what it is to be compared in, with those of the same group
    bool operator==(const Figure&) const = default;
};

/// How far a picture is from its reference, in standard errors of both: pixel by pixel the channel that is
/// farthest off, and over all channels their root mean square and the share beyond 4.
struct ZMap {
    Image image;  ///< white agrees, red is too bright, blue too dark; full colour at 5
    double rms = 0, beyond_4 = 0;
};

/// Against a reference of the same work; a picture of another size is averaged, or the reference is. Nothing
/// when their sizes are no multiples. Takes in that 8 bits round, and leaves out what is clamped.
std::optional<ZMap> z_map(const Image& picture, const Reference& reference, int spp);

/// The pictures that a result names, each after its reference and before its z-map; behind them those of
/// several kernels at equal time, side by side in a group. `folder` is where the result file lies,
/// `references` where those are.
std::vector<Figure> figures(const ResultFile& result, const std::filesystem::path& folder,
                            const std::filesystem::path& references);

}  // namespace ptb
