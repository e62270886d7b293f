#include <fmt/format.h>

#include "bench/record/json.h"
#include "bench/report/formats/formats.h"
#include "bench/report/formats/passed.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

std::string extra(const Passed& p) {
    const auto noise = p.noise();
    return fmt::format("{} samples\ntimer: {}{}", p.times_ns.size(), p.record.statistics->timer,
                       noise ? fmt::format("\nefficiency: {}", number_text(*noise->efficiency)) : "");
}

/// "± 1.2 %", or nothing where there is no interval.
void add_range(Json& json, const Statistics& s) {
    if (s.ci_low_ns && s.ci_high_ns) json["range"] = fmt::format("\u00B1 {} %", spread_text(s));
}

/// A value with its interval.
Json metric(double value, double low, double high) {
    return {{"value", value}, {"lower_value", low}, {"upper_value", high}};
}

/// One entry a timed case; `value` is in `unit`.
std::string github_action(const ResultFile& result, const char* unit, double (*value)(const Statistics&)) {
    Json list = Json::array();
    for (const Passed& p : passed(result)) {
        const Statistics& s = *p.record.statistics;
        Json json = {{"name", p.name}, {"unit", unit}, {"value", value(s)}, {"extra", extra(p)}};
        add_range(json, s);
        list.push_back(json);
    }
    return dump_json(list, 2) + "\n";
}

}  // namespace

std::string github_action_smaller(const ResultFile& result) {
    return github_action(result, "ms", [](const Statistics& s) { return ms(s.median_ns); });
}

std::string github_action_bigger(const ResultFile& result) {
    return github_action(result, "Msamples/s", [](const Statistics& s) { return s.msamples_per_s; });
}

std::string bencher(const ResultFile& result) {
    Json json = Json::object();
    for (const Passed& p : passed(result)) {
        const Statistics& s = *p.record.statistics;
        const double low = s.ci_low_ns.value_or(s.median_ns), high = s.ci_high_ns.value_or(s.median_ns);
        const double samples_ns =
            s.msamples_per_s * 1e6 * s.median_ns;  // what a render of 1 ns would do a second
        json[p.name] = {{"latency", metric(s.median_ns, low, high)},
                        {"throughput", metric(s.msamples_per_s * 1e6, samples_ns / high, samples_ns / low)}};
        if (const auto noise = p.noise()) {
            const double efficiency = *noise->efficiency;
            json[p.name]["efficiency"] =
                metric(efficiency, noise->low.value_or(efficiency), noise->high.value_or(efficiency));
        }
    }
    return dump_json(json, 2) + "\n";
}

}  // namespace ptb
