#include "core/mesh/shapes/shapes.h"

namespace ptb {
namespace {

/// Unit cubes of a grid of `side` a side, a power of three.
struct Sponge {
    int side;

    /// At every scale at most one coordinate is in the middle third.
    bool has(int x, int y, int z) const {
        if (x < 0 || y < 0 || z < 0 || x >= side || y >= side || z >= side) return false;
        for (int cells = side; cells > 1; cells /= 3, x /= 3, y /= 3, z /= 3)
            if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) > 1) return false;
        return true;
    }
};

/// Two triangles of the cube at a point of the grid, on its low or high side of an axis.
void add_face(Geometry& geometry, int grid, const int (&cube)[3], std::size_t axis, int high) {
    const auto corner = [&](int u, int v) {
        int at[3] = {cube[0], cube[1], cube[2]};
        at[axis] += high;
        at[(axis + 1) % 3] += high == 1 ? u : v;
        at[(axis + 2) % 3] += high == 1 ? v : u;
        const auto scaled = [&](int i) { return static_cast<double>(2 * i - grid) / grid; };
        return Vec3{scaled(at[0]), scaled(at[1]), scaled(at[2])};
    };
    geometry.add(corner(0, 0), corner(1, 0), corner(1, 1));
    geometry.add(corner(1, 1), corner(0, 1), corner(0, 0));
}

}  // namespace

Geometry make_menger(int detail) {
    int side = 1;
    for (int i = 0; i < detail; ++i) side *= 3;
    const Sponge sponge{side};
    Geometry geometry;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z) {
                if (!sponge.has(x, y, z)) continue;
                for (const int step : {-1, 1}) {
                    const int high = step == 1 ? 1 : 0;
                    if (!sponge.has(x + step, y, z)) add_face(geometry, side, {x, y, z}, 0, high);
                    if (!sponge.has(x, y + step, z)) add_face(geometry, side, {x, y, z}, 1, high);
                    if (!sponge.has(x, y, z + step)) add_face(geometry, side, {x, y, z}, 2, high);
                }
            }
    return geometry;
}

}  // namespace ptb
