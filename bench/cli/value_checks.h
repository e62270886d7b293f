#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

namespace ptb {

// Checks of flags' values, with the limits that config files have. CLI11's own let nan through, and wrap "-1"
// around to a large number.

/// Digits only, from `least` to `most`.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// Anything but an empty text, which is what a script passes on from a variable that nobody set. `allowed`
/// ends the message.
CLI::Validator not_empty(const std::string& allowed);

/// A finite number of seconds, more than 0 (or 0 too), at most 1e9.
CLI::Validator seconds(bool zero_allowed);

}  // namespace ptb
