#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/compare/shift.h"
#include "bench/record/record.h"
#include "bench/report/published.h"

namespace ptb {

/// One device in a ranking, by its case of the most samples.
struct Standing {
    std::string device, detail;  ///< "NVIDIA H200"; "1000 samples per pixel at 1024x1024"
    double value = 0;
    std::optional<Interval> interval{};  ///< 95 %
    std::optional<std::size_t> run{};    ///< whose it is; none for a published one
};

/// Devices by one measure of the same work, the best first.
struct Ranking {
    std::string title, unit, work, note;  ///< "bdpt"; "Msegments/s"; "scene thesis, path length 8"
    std::vector<Standing> standings;
};

/// What the runs' devices can be ranked by: the speed of each kernel, `pt` first, then the efficiency of
/// those that make one picture, then what energies there are. A kernel's work is the usual one; where it does
/// not do that, the one that the most devices did. Kernels that met triangles have a ranking of these, too.
/// Published devices stand where their samples a second put them: their segments are taken for those that the
/// same kernel traces in these runs.
std::vector<Ranking> rankings(const std::vector<const ResultFile*>& runs, const PublishedTable& published);

}  // namespace ptb
