#pragma once

#include <cstdint>
#include <limits>

/// What flags and config files allow alike.
namespace ptb::limits {

inline constexpr int most_repetitions = 1'000'000;
inline constexpr double most_seconds = 1e9;
inline constexpr std::uint64_t most_seed =
    std::numeric_limits<std::uint32_t>::max();  ///< kernels hash 32 bits

}  // namespace ptb::limits
