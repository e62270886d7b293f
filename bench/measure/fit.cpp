#include "bench/measure/fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace ptb {

namespace {

constexpr double bad_residual = 0.05;  ///< of a point, relative
constexpr std::size_t fewest_points = 3;

struct Sums {
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

Sums weighted_sums(std::span<const SppPoint> points) {
    Sums s;
    for (const SppPoint& p : points) {
        const double w = 1 / (p.ns * p.ns);
        s.w += w;
        s.x += w * p.spp;
        s.y += w * p.ns;
        s.xx += w * p.spp * p.spp;
        s.xy += w * p.spp * p.ns;
        s.yy += w * p.ns * p.ns;
    }
    return s;
}

/// The point farthest from the line, and how far in shares of its time.
std::pair<SppPoint, double> worst(std::span<const SppPoint> points, double a, double b) {
    std::pair<SppPoint, double> found;
    for (const SppPoint& p : points) {
        const double residual = (p.ns - a - b * p.spp) / p.ns;
        if (std::abs(residual) > std::abs(found.second)) found = {p, residual};
    }
    return found;
}

std::string warning_of(std::span<const SppPoint> points, double a, double b) {
    const auto [p, residual] = worst(points, a, b);
    if (b <= 0) return "time does not grow with SPP: the work is too small to see; raise --size or --spp";
    if (std::abs(residual) <= bad_residual) return "";
    return fmt::format(
        "SPP {} lies {:.0f} % {} the line: time per sample is not constant here; likely the clock moved or "
        "other programs ran: repeat (`ptbench doctor` says what disturbs)",
        p.spp, 100 * std::abs(residual), residual > 0 ? "above" : "below");
}

bool fits(const Record& record) {
    return record.status == Status::ok && record.statistics && record.statistics->median_ns > 0;
}

}  // namespace

SppFit fit_line(std::span<const SppPoint> points) {
    const Sums s = weighted_sums(points);
    const double b = (s.w * s.xy - s.x * s.y) / (s.w * s.xx - s.x * s.x);
    const double a = (s.y - b * s.x) / s.w;
    const double total = s.yy - s.y * s.y / s.w;
    double left = 0;
    for (const SppPoint& p : points) left += std::pow((p.ns - a - b * p.spp) / p.ns, 2);
    SppFit fit;
    fit.points = static_cast<int>(points.size());
    fit.overhead_ms = a * 1e-6;
    fit.ms_per_spp = b * 1e-6;
    fit.r2 = total > 0 ? 1 - left / total : 1;
    fit.warning = warning_of(points, a, b);
    return fit;
}

std::vector<SppFit> fits_over_spp(const std::vector<Record>& records) {
    std::map<Case, std::map<int, double>> lines;  ///< by the case without its SPP
    for (const Record& record : records) {
        if (!fits(record)) continue;
        Case key = record.params;
        key.spp = 1;
        lines[key][record.params.spp] = record.statistics->median_ns;
    }
    std::vector<SppFit> fits;
    for (const auto& [key, times] : lines) {
        if (times.size() < fewest_points) continue;
        std::vector<SppPoint> points;
        for (const auto& [spp, ns] : times) points.push_back({static_cast<double>(spp), ns});
        fits.push_back(fit_line(points));
        fits.back().params = key;
        fits.back().params.spp = times.rbegin()->first;
    }
    return fits;
}

}  // namespace ptb
