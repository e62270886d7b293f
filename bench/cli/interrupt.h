#pragma once

#include <atomic>
#include <exception>

namespace ptb {

/// Interrupted before there was anything to keep. Ends the run with exit code 130.
struct Interrupted : std::exception {};

/// From now on the first SIGINT or SIGTERM only sets the flag that is returned; the second ends the process
/// at once with exit code 130.
const std::atomic<bool>& watch_for_interruption();

}  // namespace ptb
