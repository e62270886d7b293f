#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/plan/tuned.h"

namespace ptb {
namespace {

constexpr std::size_t most_cases = 100'000;
constexpr auto segment_limit = std::int64_t{1} << 32;  ///< of a pixel, which counts them in 32 bits

/// Place of an axis in the nesting; linked axes stand where their outermost one does.
std::size_t depth_of(const Axis& axis) {
    const auto names = axis_names();
    std::size_t outermost = names.size();
    for (const auto& name : axis.names) {
        const auto found = std::find(names.begin(), names.end(), name);
        outermost = std::min(outermost, static_cast<std::size_t>(found - names.begin()));
    }
    return outermost;
}

/// Every case of `cases` at every point of the axis, the axis innermost.
std::vector<Case> cross(const std::vector<Case>& cases, const Axis& axis) {
    if (cases.size() * axis.points.size() > most_cases)
        throw UsageError(fmt::format("axis: a series of more than {} cases; sweep fewer values", most_cases));
    std::vector<Case> crossed;
    for (const Case& c : cases) {
        for (const auto& point : axis.points) {
            Case& next = crossed.emplace_back(c);
            for (std::size_t i = 0; i < axis.names.size(); ++i)
                set_case_value(next, axis.names[i], point.at(i));
        }
    }
    return crossed;
}

std::vector<Case> expand_series(const Series& series) {
    auto axes = series.axes;
    std::stable_sort(axes.begin(), axes.end(),
                     [](const Axis& a, const Axis& b) { return depth_of(a) < depth_of(b); });
    std::vector<Case> cases = {default_case()};
    for (const Axis& axis : axes) cases = cross(cases, axis);
    for (const Case& c : cases) check_case(c);
    return cases;
}

/// A series and its cases, their device still empty.
using SeriesCases = std::vector<std::pair<Series, std::vector<Case>>>;

SeriesCases expand_for_any_device(const Config& config) {
    SeriesCases all;
    std::size_t expanded = 0;
    for (const Series& series : config.series.empty() ? std::vector<Series>(1) : config.series) {
        all.emplace_back(series, expand_series(series));
        if ((expanded += all.back().second.size()) > most_cases)
            throw UsageError(
                fmt::format("series: more than {} cases in all; sweep fewer values", most_cases));
    }
    return all;
}

/// A picture of several devices is planned with the first of them alone. Sets how many "all" are, once
/// devices are known.
bool is_planned_with(const DeviceInfo& device, const std::vector<DeviceInfo>& devices, Case& c) {
    if (c.devices == 1 || device.key.empty()) return true;
    const auto same_type = [&](const DeviceInfo& each) { return each.type == device.type; };
    if (c.devices == 0)
        c.devices = static_cast<int>(std::count_if(devices.begin(), devices.end(), same_type));
    return std::find_if(devices.begin(), devices.end(), same_type)->key == device.key;
}

/// Equal cases once.
void append_for(const DeviceInfo& device, const std::vector<DeviceInfo>& devices, const SeriesCases& plan,
                const std::vector<Case>& tuned, std::vector<Case>& cases) {
    std::set<Case> seen;
    for (const auto& [series, series_cases] : plan)
        for (Case c : series_cases) {
            c.device = device.key;
            if (!is_planned_with(device, devices, c)) continue;
            apply_tuned(c, series, tuned);
            if (seen.insert(c).second) cases.push_back(c);
        }
}

}  // namespace

int most_spp(int path_length) {
    return static_cast<int>(
        std::min((segment_limit - 1) / path_length, std::int64_t{std::numeric_limits<int>::max()}));
}

void check_case(const Case& c) {
    const auto segments = static_cast<std::int64_t>(c.spp) * c.path_length;
    if (c.spp > most_spp(c.path_length))
        throw UsageError(
            fmt::format("spp x path_length: found {} x {} = {}; allowed: less than {}, the most segments "
                        "that one pixel counts",
                        c.spp, c.path_length, segments, segment_limit));
}

std::vector<Case> expand(const Config& config, const std::vector<DeviceInfo>& devices,
                         const std::vector<Case>& tuned) {
    const auto plan = expand_for_any_device(config);
    std::vector<Case> cases;
    for (const DeviceInfo& device : devices) append_for(device, devices, plan, tuned, cases);
    return cases;
}

}  // namespace ptb
