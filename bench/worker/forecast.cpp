#include "bench/worker/forecast.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/measure/stop_rule.h"

namespace ptb {

CostKey cost_key(const Case& c) { return {c.device, c.kernel, c.scene, c.path_length, c.lanes, c.variant}; }

bool Forecast::learn(const Record& measured) {
    const Case& c = measured.params;
    const bool usual = c.work_group.implicit() && c.devices == 1 && c.together == Together::no;
    if (!measured.statistics || !usual) return false;
    learn(c, measured.statistics->median_ns / (static_cast<double>(c.size.pixels()) * c.spp));
    return true;
}

std::optional<double> Forecast::sample_s(const Case& c) const {
    const auto found = ns_per_sample_.find(cost_key(c));
    if (found == ns_per_sample_.end()) return std::nullopt;
    return found->second * 1e-9 * c.size.width * c.size.height * c.spp;
}

std::optional<double> Forecast::case_s(const Case& c) const {
    const auto sample = sample_s(c);
    if (!sample || measure_.skip_time) return sample ? std::optional(0.0) : std::nullopt;
    const int wanted = std::min(enough_samples(*sample, measure_.min_samples), measure_.max_samples);
    const double fit = *sample > 0 ? std::floor(measure_.max_time_s / *sample) : wanted;
    const double timed = std::clamp(fit, 1.0, double(wanted));
    const double warmup =
        *sample > long_sample_s ? 0 : measure_.warmup.value_or(usual_warmup(*sample, measure_.max_time_s));
    return (warmup + timed) * *sample;
}

std::string duration_text(double seconds) {
    if (seconds < 9.95) return fmt::format("{:.1f} s", std::max(seconds, 0.0));
    const auto whole = static_cast<long long>(std::llround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    const auto minutes = (whole + 30) / 60;
    if (minutes < 120) return fmt::format("{} min", minutes);
    return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string prediction_text(const Forecast& forecast, const std::vector<Case>& cases,
                            double max_total_time_s) {
    double total_s = 0, longest_s = -1;
    const Case* longest = nullptr;
    for (const Case& c : cases) {
        total_s += forecast.case_s(c).value_or(0);
        const double sample_s = forecast.sample_s(c).value_or(-1);
        if (sample_s <= longest_s) continue;
        longest_s = sample_s;
        longest = &c;
    }
    if (longest == nullptr) return {};
    const bool all =
        std::all_of(cases.begin(), cases.end(), [&](const Case& c) { return forecast.knows(c); });
    const bool cut = max_total_time_s > 0 && total_s > max_total_time_s;
    return fmt::format("predicted: {}{}{} (longest sample: {} on {}, spp {}: {})", all ? "" : "at least ",
                       duration_text(total_s),
                       cut ? fmt::format(", cut to the budget of {}", duration_text(max_total_time_s)) : "",
                       longest->kernel, longest->device, longest->spp, duration_text(longest_s));
}

}  // namespace ptb
