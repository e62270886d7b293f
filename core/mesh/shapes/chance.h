#pragma once

#include <cstdint>

#include "core/mesh/mesh.h"

namespace ptb {

/// 64 well mixed bits of a number; the finaliser of "Fast Splittable Pseudorandom Number Generators", by
/// Steele, Lea and Flood.
inline std::uint64_t mixed_bits(std::uint64_t number) {
    std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// Of a number: between -1 and 1.
inline double mixed_signed(std::uint64_t number) {
    return static_cast<double>(mixed_bits(number) >> 11) * 0x1p-52 - 1;
}

/// Numbers that look random, the same wherever they are drawn.
class Chance {
  public:
    explicit Chance(std::uint64_t stream) : next_(stream << 32) {}
    /// In [-1, 1).
    double number() { return mixed_signed(next_++); }
    /// In the cube from -1 to 1.
    Vec3 point() {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }
    /// On the unit sphere, all directions alike.
    Vec3 direction() {
        for (;;) {
            const Vec3 p = point();
            if (const double squared = dot(p, p); squared > 0.01 && squared <= 1) return normalized(p);
        }
    }

  private:
    std::uint64_t next_;
};

}  // namespace ptb
