#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "bench/plan/config.h"

namespace ptb {

/// "5%" -> 0.05. Throws UsageError unless it is a percentage above 0 and at most 100.
double parse_percent(std::string_view text);
/// 0.05 -> "5%", which `parse_percent` reads back.
std::string percent_text(double share);

/// Which change of a case's time passes: what a flag says, else the case's series, else its config, else
/// `otherwise`.
class Tolerances {
  public:
    Tolerances(const Config& config, std::optional<double> flag, double otherwise);
    double of(Case c) const;

  private:
    std::map<Case, double> of_case_;  ///< by cases without their device
    double otherwise_;
};

}  // namespace ptb
