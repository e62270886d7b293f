#pragma once

#include <cstdint>

namespace ptb {

/// 64 random bits a step from a counter and a finalising hash; see "Fast Splittable Pseudorandom Number
/// Generators", by Steele, Lea and Flood. Chosen because its state is one word, so each pixel can own a
/// generator seeded by a hash (the picture then does not depend on threads), and because no kernel uses it.
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1), 53 bits.
    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  private:
    std::uint64_t state_;
};

/// The multiplicative generator of "Random Number Generators: Good Ones Are Hard to Find", by Park and
/// Miller.
class ParkMiller {
  public:
    static constexpr std::uint64_t modulus = 2147483647;

    /// Any `seed` is folded into the generator's states, [1, modulus - 1].
    explicit ParkMiller(std::uint64_t seed) : state_(seed % (modulus - 1) + 1) {}

    /// Uniform in (0, 1), 31 bits.
    double uniform() {
        state_ = state_ * 16807 % modulus;
        return static_cast<double>(state_) / static_cast<double>(modulus);
    }

  private:
    std::uint64_t state_;
};

/// The seed of one pixel's own generator.
inline std::uint64_t pixel_seed(std::uint64_t seed, std::uint64_t pixel) {
    return SplitMix64(SplitMix64(seed).next() + pixel).next();
}

}  // namespace ptb
