#include "bench/measure/counted.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace ptb {
namespace {

constexpr const char* unseen_lanes =
    "lanes alive: one lane a work-item, and this device does not tell which of them run together";

std::optional<double> peak_value(const std::vector<Peak>& peaks, const std::string& name) {
    const auto found =
        std::find_if(peaks.begin(), peaks.end(), [&](const Peak& peak) { return peak.name == name; });
    return found == peaks.end() || !found->value || *found->value <= 0 ? std::nullopt : found->value;
}

/// The largest share. Roots and divisions add up: they wait for the same unit.
void find_limit(PeakShares& shares) {
    std::optional<double> roots;
    if (shares.sqrt || shares.division) roots = shares.sqrt.value_or(0) + shares.division.value_or(0);
    for (const auto& [name, share] :
         {std::pair("fma", shares.fma), std::pair("roots", roots), std::pair("global", shares.global)}) {
        if (!share || (shares.limit_share && *share <= *shares.limit_share)) continue;
        shares.limit = name;
        shares.limit_share = share;
    }
}

}  // namespace

Counted counted_of(const Counts& counts, std::uint64_t segments) {
    Counted counted;
    if (counts.segments != segments || segments == 0) {
        counted.reason = fmt::format("the instrumented build counted {} segments, its film has {}",
                                     counts.segments, segments);
        return counted;
    }
    const auto n = static_cast<double>(segments);
    const auto each = [n](std::uint64_t sum) { return static_cast<double>(sum) / n; };
    counted.segments = segments;
    counted.flops_per_segment = each(counts.flops);
    counted.roots_per_segment = each(counts.roots);
    counted.divisions_per_segment = each(counts.divisions);
    counted.bytes_per_segment = each(counts.bytes);
    if (counts.searches > 0) {
        const auto rays = static_cast<double>(counts.searches);
        counted.nodes_per_ray = static_cast<double>(counts.nodes) / rays;
        counted.triangles_per_ray = static_cast<double>(counts.triangles) / rays;
    }
    if (counts.lanes > 0)
        counted.lanes_alive = n / static_cast<double>(counts.lanes);
    else
        counted.reason = unseen_lanes;
    return counted;
}

PeakShares shares_of(const Counted& counted, double msegments_per_s, const std::vector<Peak>& peaks) {
    const auto share = [&](const std::optional<double>& per_segment,
                           const char* name) -> std::optional<double> {
        const auto peak = peak_value(peaks, name);  // billions a second
        if (!peak || !per_segment) return std::nullopt;
        return *per_segment * msegments_per_s / 1e3 / *peak;
    };
    PeakShares shares{share(counted.flops_per_segment, "fma"),
                      share(counted.roots_per_segment, "sqrt"),
                      share(counted.divisions_per_segment, "division"),
                      share(counted.bytes_per_segment, "global"),
                      "",
                      {}};
    find_limit(shares);
    return shares;
}

void add_shares(std::vector<Record>& records, const std::vector<DevicePeaks>& peaks) {
    for (Record& record : records)
        for (const DevicePeaks& device : peaks)
            if (record.counted && record.statistics && device.device == record.params.device)
                record.counted->of_peak =
                    shares_of(*record.counted, record.statistics->msegments_per_s, device.peaks);
}

}  // namespace ptb
