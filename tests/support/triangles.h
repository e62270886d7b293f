#pragma once

#include <cstdint>
#include <vector>

#include "core/tree/triangle.h"

namespace ptb {

using Triangles = std::vector<Triangle>;

/// Uniform numbers that are the same everywhere.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    double uniform();  ///< in [0, 1)
    float between(float low, float high) { return low + (high - low) * static_cast<float>(uniform()); }

  private:
    std::uint64_t state_;
};

/// Small triangles anywhere in the cube of 1 around the origin.
Triangles soup(int count, float size, std::uint64_t seed = 1);

/// The inside of a cube of this half edge around the origin: 12 triangles.
Triangles room(float half_edge);

/// A sphere and nine on it of a third its radius, and so on; each of 2 x `rings`^2 triangles or so.
Triangles flake(int levels, int rings);

/// Menger's sponge, the faces that show.
Triangles menger(int levels);

/// Ribbons that stand on a ball and bend.
Triangles hair(int strands, int segments, std::uint64_t seed = 1);

/// Needles through the cube of 1 around the origin.
Triangles slivers(int count, std::uint64_t seed = 1);

/// Hills over a square, 2 x `cells`^2 triangles, open.
Triangles terrain(int cells);

Triangles with(Triangles all, const Triangles& more);

}  // namespace ptb
