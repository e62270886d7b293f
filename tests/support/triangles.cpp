#include "tests/support/triangles.h"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "core/scene/vec3.h"

namespace ptb {
namespace {

std::array<float, 3> corner(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

void add(Triangles& to, const Vec3& a, const Vec3& b, const Vec3& c) {
    to.push_back({{corner(a), corner(b), corner(c)}});
}

void add_quad(Triangles& to, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    add(to, a, b, c);
    add(to, a, c, d);
}

Vec3 on_sphere(double up, double around) {
    return {std::sin(up) * std::cos(around), std::cos(up), std::sin(up) * std::sin(around)};
}

Vec3 random_point(Dice& dice) {
    const double x = dice.uniform(), y = dice.uniform();
    return Vec3{x, y, dice.uniform()} * 2 - Vec3{1, 1, 1};
}

Vec3 random_direction(Dice& dice) {
    const double height = 2 * dice.uniform() - 1;
    return on_sphere(std::acos(height), 2 * std::numbers::pi * dice.uniform());
}

void add_ball(Triangles& to, const Vec3& centre, double radius, int rings) {
    const auto at = [&](int ring, int column) {
        const double step = std::numbers::pi / rings;
        return centre + radius * on_sphere(ring * step, (column % (2 * rings)) * step);
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int column = 0; column < 2 * rings; ++column) {
            if (ring > 0) add(to, at(ring, column), at(ring, column + 1), at(ring + 1, column));
            if (ring + 1 < rings)
                add(to, at(ring, column + 1), at(ring + 1, column + 1), at(ring + 1, column));
        }
    }
}

struct Frame {
    Vec3 across, along, up;
};

Frame frame_around(const Vec3& up) {
    const Vec3 across = normalized(cross(up, std::abs(up.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    return {across, cross(across, up), up};
}

void add_flake(Triangles& to, const Vec3& centre, double radius, const Frame& frame, int levels, int rings) {
    add_ball(to, centre, radius, rings);
    if (levels == 0) return;
    for (int i = 0; i < 9; ++i) {
        const double up = i < 6 ? 0.5 * std::numbers::pi : 0.25 * std::numbers::pi;
        const double around = i < 6 ? i * std::numbers::pi / 3 : (2 * i + 1) * std::numbers::pi / 3;
        const Vec3 local = on_sphere(up, around);
        const Vec3 way = local.x * frame.across + local.y * frame.up + local.z * frame.along;
        add_flake(to, centre + way * (radius * 4 / 3), radius / 3, frame_around(way), levels - 1, rings);
    }
}

/// Whether the cell of the sponge of 3^levels a side is solid.
bool solid(int x, int y, int z, int cells) {
    for (const int i : {x, y, z})
        if (i < 0 || i >= cells) return false;
    for (; cells > 1; cells /= 3, x /= 3, y /= 3, z /= 3)
        if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) > 1) return false;
    return true;
}

void add_cell_faces(Triangles& to, int x, int y, int z, int cells) {
    const double edge = 2.0 / cells;
    const Vec3 low = Vec3{1.0 * x, 1.0 * y, 1.0 * z} * edge - Vec3{1, 1, 1};
    const Vec3 axes[3] = {{edge, 0, 0}, {0, edge, 0}, {0, 0, edge}};
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 &w = axes[axis], &u = axes[(axis + 1) % 3], &v = axes[(axis + 2) % 3];
        const int dx = axis == 0, dy = axis == 1, dz = axis == 2;
        if (!solid(x - dx, y - dy, z - dz, cells)) add_quad(to, low, low + v, low + u + v, low + u);
        const Vec3 top = low + w;
        if (!solid(x + dx, y + dy, z + dz, cells)) add_quad(to, top, top + u, top + u + v, top + v);
    }
}

void add_strand(Triangles& to, Dice& dice, int segments) {
    const Vec3 root = random_direction(dice);
    const Vec3 bend = 0.6 * random_direction(dice) + Vec3{0, -0.4, 0};
    const Vec3 side = 0.002 * normalized(cross(root, random_direction(dice)));
    const auto at = [&](int i) {
        const double way = 1.0 * i / segments;
        return 0.6 * root + 0.5 * way * root + 0.5 * way * way * bend;
    };
    for (int i = 0; i < segments; ++i) {
        const Vec3 width = side * (1 - 0.9 * i / segments), next = side * (1 - 0.9 * (i + 1) / segments);
        add_quad(to, at(i) - width, at(i) + width, at(i + 1) + next, at(i + 1) - next);
    }
}

double hill(double x, double z) {
    double height = 0;
    for (int octave = 0; octave < 7; ++octave) {
        const double f = std::exp2(octave);
        height += std::sin(2.1 * f * x + 1.3 * octave) * std::sin(1.7 * f * z + 0.7 * octave) / f;
    }
    return 0.3 * height;
}

}  // namespace

double Dice::uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t bits = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((bits ^ (bits >> 31)) >> 11) * 0x1p-53;
}

Triangles soup(int count, float size, std::uint64_t seed) {
    Dice dice(seed);
    Triangles triangles;
    for (int i = 0; i < count; ++i) {
        const Vec3 centre = random_point(dice);
        const Vec3 a = random_point(dice), b = random_point(dice), c = random_point(dice);
        add(triangles, centre + size * a, centre + size * b, centre + size * c);
    }
    return triangles;
}

Triangles room(float half_edge) {
    Triangles triangles;
    add_cell_faces(triangles, 0, 0, 0, 1);
    for (Triangle& triangle : triangles) {
        std::swap(triangle.corners[1], triangle.corners[2]);
        for (auto& of_corner : triangle.corners)
            for (float& coordinate : of_corner) coordinate *= half_edge;
    }
    return triangles;
}

Triangles flake(int levels, int rings) {
    Triangles triangles;
    add_flake(triangles, {0, 0, 0}, 0.6, frame_around({0, 1, 0}), levels, rings);
    return triangles;
}

Triangles menger(int levels) {
    Triangles triangles;
    int cells = 1;
    for (int i = 0; i < levels; ++i) cells *= 3;
    for (int x = 0; x < cells; ++x)
        for (int y = 0; y < cells; ++y)
            for (int z = 0; z < cells; ++z)
                if (solid(x, y, z, cells)) add_cell_faces(triangles, x, y, z, cells);
    return triangles;
}

Triangles hair(int strands, int segments, std::uint64_t seed) {
    Dice dice(seed);
    Triangles triangles;
    add_ball(triangles, {0, 0, 0}, 0.6, 32);
    for (int i = 0; i < strands; ++i) add_strand(triangles, dice, segments);
    return triangles;
}

Triangles slivers(int count, std::uint64_t seed) {
    Dice dice(seed);
    Triangles triangles;
    for (int i = 0; i < count; ++i) {
        const Vec3 middle = 0.8 * random_point(dice), way = random_direction(dice);
        const Vec3 side = 0.004 * normalized(cross(way, random_direction(dice)));
        add(triangles, middle - 0.6 * way - side, middle - 0.6 * way + side, middle + 0.6 * way);
    }
    return triangles;
}

Triangles terrain(int cells) {
    Triangles triangles;
    const auto at = [&](int i, int j) {
        const double x = 2.0 * i / cells - 1, z = 2.0 * j / cells - 1;
        return Vec3{x, hill(x, z), z};
    };
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j)
            add_quad(triangles, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    return triangles;
}

Triangles with(Triangles all, const Triangles& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace ptb
