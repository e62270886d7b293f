#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace ptb {

/// `text` made safe for a terminal and for one line: control characters, escape codes, characters that turn
/// the direction of writing and bytes that are not UTF-8 become '?'; line breaks and tabs become spaces.
std::string printable(std::string_view text);

/// Characters (code points) in UTF-8 text: its width in a terminal, near enough.
std::size_t width(std::string_view utf8);

/// Bytes of the first `most` characters of UTF-8 text that has as many.
std::size_t first_bytes(std::string_view utf8, std::size_t most);

/// `text` shortened to `most` characters, ending in "..." when it was longer.
std::string shortened(std::string_view utf8, std::size_t most);

/// Two texts that differ, printable and shortened to `most` characters each. Of longer ones the words that
/// both begin with are left out ("... -DLANES=8"), so that what differs is shown.
std::pair<std::string, std::string> where_they_differ(std::string_view one, std::string_view other,
                                                      std::size_t most);

}  // namespace ptb
