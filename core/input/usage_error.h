#pragma once

#include <stdexcept>

namespace ptb {

/// A user's mistake in a flag, an axis or an input file. `what()` is one line: the flag or file and JSON
/// pointer, what was found, what is allowed. Ends the run with exit code 2.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace ptb
