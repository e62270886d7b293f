#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/plan/config.h"

namespace ptb {

/// The names of an axis: "spp", or "(spp,size)" for linked ones. Throws UsageError.
std::vector<std::string> parse_axis_names(std::string_view text);
/// What `parse_axis_names` reads back.
std::string axis_key(const std::vector<std::string>& names);

/// Values of an axis from text: one value, or a list in brackets whose items are values or ranges
/// `first:last:step`, `first:last:xfactor`; of linked axes: points "(10,1024)"; "\," is a comma in a value.
/// Unchecked but for the grammar.
std::vector<std::vector<std::string>> parse_axis_points(const std::vector<std::string>& names,
                                                        std::string_view text);

/// Throws UsageError unless the axis has points, each with a good value for every name.
void check_axis(const Axis& axis);

}  // namespace ptb
