#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ptb {

/// The candidate that `word` was probably meant to be: fewest edits (insert, delete, replace, swap
/// neighbours), at most a third of the longer word's letters, the case of letters ignored. The first one wins
/// a tie.
std::optional<std::string> nearest_match(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean spp?", or nothing when no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace ptb
