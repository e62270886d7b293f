#pragma once

#include <string>
#include <string_view>

namespace ptb {

/// 16 hexadecimal digits of the text's FNV-1a.
std::string text_hash(std::string_view text);

}  // namespace ptb
