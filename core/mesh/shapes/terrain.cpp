#include "core/mesh/shapes/chance.h"
#include "core/mesh/shapes/shapes.h"

namespace ptb {
namespace {

/// Heights of a lattice of 2^octave cells a side, straight between its points. `x` and `z` in [0, 1].
double wave(int octave, double x, double z) {
    const double cells = static_cast<double>(1 << octave);
    const auto column = static_cast<std::uint64_t>(x * cells), row = static_cast<std::uint64_t>(z * cells);
    const double u = x * cells - static_cast<double>(column), v = z * cells - static_cast<double>(row);
    const auto height = [&](std::uint64_t across, std::uint64_t down) {
        return mixed_signed(static_cast<std::uint64_t>(octave) << 48 | (column + across) << 24 |
                            (row + down));
    };
    return (height(0, 0) * (1 - u) + height(1, 0) * u) * (1 - v) +
           (height(0, 1) * (1 - u) + height(1, 1) * u) * v;
}

/// Waves of half the height for each half the length; see "The Fractal Geometry of Nature", by Mandelbrot.
double height(int octaves, double x, double z) {
    double sum = 0, amplitude = 0.3;
    for (int octave = 1; octave <= octaves; ++octave, amplitude /= 2) sum += amplitude * wave(octave, x, z);
    return sum;
}

}  // namespace

Geometry make_terrain(int detail) {
    const int cells = 1 << detail;
    const auto corner = [&](int column, int row) {
        const double x = static_cast<double>(column) / cells, z = static_cast<double>(row) / cells;
        return Vec3{2 * x - 1, height(detail, x, z), 2 * z - 1};
    };
    Geometry terrain;
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
            const Vec3 a = corner(column, row), b = corner(column, row + 1), c = corner(column + 1, row + 1),
                       d = corner(column + 1, row);
            terrain.add(a, b, c);
            terrain.add(c, d, a);
        }
    return terrain;
}

}  // namespace ptb
