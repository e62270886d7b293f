#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "bench/plan/config.h"
#include "bench/record/record.h"

namespace ptb {

/// What decides how long a pixel sample takes.
using CostKey = std::tuple<std::string, std::string, std::string, int, int, Variant>;
CostKey cost_key(const Case& c);  ///< device, kernel, scene, path length, lanes, variant

/// Predicts times of cases from the measured cost of a pixel sample. Seconds; nothing where nothing is known.
class Forecast {
  public:
    explicit Forecast(const MeasureOptions& measure) : measure_(measure) {}

    void learn(const Case& c, double ns_per_sample) { ns_per_sample_[cost_key(c)] = ns_per_sample; }
    /// Of a case that was measured as most are. False where it has no time.
    bool learn(const Record& measured);
    bool knows(const Case& c) const { return ns_per_sample_.contains(cost_key(c)); }

    /// One timed sample: one render of the case's work.
    std::optional<double> sample_s(const Case& c) const;

    /// Warm-up and the fewest timed samples that may be enough, `max_time_s` allowing.
    std::optional<double> case_s(const Case& c) const;

  private:
    MeasureOptions measure_;
    std::map<CostKey, double> ns_per_sample_;
};

/// "0.4 s", "12 s", "3 min 20 s", "2 h 5 min"
std::string duration_text(double seconds);

/// "predicted: 34 min (longest sample: thesis on pocl:0, spp 1000: 29 min)", "at least" where not all is
/// known; nothing when nothing is.
std::string prediction_text(const Forecast& forecast, const std::vector<Case>& cases,
                            double max_total_time_s);

}  // namespace ptb
