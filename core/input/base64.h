#pragma once

#include <string>
#include <string_view>

namespace ptb {

/// Bytes as base64 (RFC 4648).
std::string base64(std::string_view bytes);

/// The bytes of base64 text. Throws UsageError on anything else.
std::string from_base64(std::string_view text);

}  // namespace ptb
