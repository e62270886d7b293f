#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ptb {

/// The candidate with the fewest single-letter edits from `word`, the first of equals; empty without
/// candidates. See "Binary Codes Capable of Correcting Deletions, Insertions and Reversals", by Levenshtein.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

}  // namespace ptb
