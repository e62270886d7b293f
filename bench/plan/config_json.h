#pragma once

#include "bench/plan/config.h"
#include "core/input/json.h"

namespace ptb {

/// The axes and the name of one element of a config's "series".
Series parse_series(const Json& json, const Where& where);
/// "5%"
double read_tolerance(const Json& json, const Where& where);
/// What `parse_series` reads back.
Json series_to_json(const Series& series);

}  // namespace ptb
