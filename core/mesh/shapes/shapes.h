#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/geometry.h"

namespace ptb {

/// A mesh made from a formula: of integers, sums, products, quotients and roots, which are the same on every
/// machine.
struct Shape {
    std::string name;
    std::uint64_t (*triangles)(int detail) = nullptr;
    Geometry (*make)(int detail) = nullptr;

    /// How much detail that many triangles allow; -1: none.
    int most_detail(std::uint64_t most_triangles) const;
};

/// All of them are about as large as the cube from -1 to 1. Closed ones are wound outwards.
const std::vector<Shape>& shapes();

/// The cube from -1 to 1.
Geometry make_box(int detail);
/// The unit sphere: an octahedron cut finer, its corners on the sphere.
Geometry make_sphere(int detail);
/// 820 spheres, each with nine of a third of its size around it, as in "A Proposal for Standard Graphics
/// Environments", by Haines.
Geometry make_flake(int detail);
/// A tube along the knot that winds twice around a torus and three times through it.
Geometry make_knot(int detail);
/// Menger's sponge of level `detail`.
Geometry make_menger(int detail);
/// Ribbons that grow out of the unit sphere and hang down. Open.
Geometry make_hair(int detail);
/// Triangles a hundred times and more as long as they are wide. Open.
Geometry make_slivers(int detail);
/// Heights over a square, rougher with each step of detail. Open.
Geometry make_terrain(int detail);

}  // namespace ptb
