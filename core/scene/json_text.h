#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace ptb {

/// Parses JSON that nobody vouches for: numbers that overflow, keys that appear twice and nesting deeper than
/// 64 are errors too. Throws SceneError, one line: "ORIGIN:LINE:COLUMN: what is wrong".
nlohmann::json parse_scene_json(std::string_view text, const std::string& origin);

/// `value` as one line of printable ASCII, cut to `most_letters`, for messages.
std::string shown(const nlohmann::json& value, std::size_t most_letters = 60);

}  // namespace ptb
