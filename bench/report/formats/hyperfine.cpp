#include <algorithm>
#include <cmath>

#include "bench/compare/evidence.h"
#include "bench/plan/config.h"
#include "bench/record/json.h"
#include "bench/report/formats/formats.h"
#include "bench/report/formats/passed.h"

namespace ptb {
namespace {

Json parameters(const Case& c) {
    Json json = {{"device", c.device}};
    for (const std::string& axis : axis_names()) json[axis] = case_value(c, axis);
    return json;
}

Json entry(const Passed& p) {
    std::vector<double> seconds;
    for (const double ns : p.times_ns) seconds.push_back(ns / 1e9);
    const Moments m = moments(seconds);
    const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
    return {{"command", p.name},
            {"mean", m.mean},
            {"stddev", seconds.size() > 1 ? Json(m.sd) : Json(nullptr)},
            {"median", p.record.statistics->median_ns / 1e9},
            {"user", 0.0},
            {"system", 0.0},
            {"min", *least},
            {"max", *most},
            {"times", encode(seconds)},
            {"exit_codes", std::vector<int>(seconds.size(), 0)},
            {"parameters", parameters(p.record.params)}};
}

}  // namespace

std::string hyperfine(const ResultFile& result) {
    Json results = Json::array();
    for (const Passed& p : passed(result)) results.push_back(entry(p));
    return dump_json({{"results", results}}, 2) + "\n";
}

}  // namespace ptb
