#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/record/record.h"

namespace ptb {

/// "ok", "invalid", "unsupported", ...
std::string to_string(Status status);
std::optional<Status> parse_status(std::string_view text);

}  // namespace ptb
