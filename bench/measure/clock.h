#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

namespace ptb {

/// The host's monotonic clock, nanoseconds.
inline std::int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Seconds since `begin_ns`.
inline double seconds_since(std::int64_t begin_ns) { return static_cast<double>(now_ns() - begin_ns) * 1e-9; }

/// CPU time of this process so far, its children's left out.
inline double process_cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace ptb
