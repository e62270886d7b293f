#include "core/mesh/shapes/chance.h"
#include "core/mesh/shapes/shapes.h"

namespace ptb {
namespace {

constexpr int hair_pieces = 16;
constexpr double hair_length = 0.8, scalp_radius = 0.5;

/// A ribbon of 16 pieces, each two triangles, that becomes narrow toward its end.
void add_hair(Geometry& hair, Chance& chance, double width) {
    Vec3 way = chance.direction();
    Vec3 here = way * scalp_radius;
    const Vec3 side = normalized(cross(way, chance.direction()));
    const auto half_width = [&](int piece) {
        return side * (width / 2 * (1 - 0.9 * piece / static_cast<double>(hair_pieces)));
    };
    for (int piece = 0; piece < hair_pieces; ++piece) {
        const Vec3 next = here + way * (hair_length / hair_pieces);
        const Vec3 before = half_width(piece), after = half_width(piece + 1);
        hair.add(here - before, here + before, next + after);
        hair.add(next + after, next - after, here - before);
        here = next;
        way = normalized(way + Vec3{0, -0.15, 0} + chance.point() * 0.1);
    }
}

}  // namespace

Geometry make_hair(int detail) {
    Geometry hair;
    for (int i = 0; i < 40 << (2 * detail); ++i) {
        Chance chance(static_cast<std::uint64_t>(i));
        add_hair(hair, chance, 0.02 / (1 << detail));
    }
    return hair;
}

Geometry make_slivers(int detail) {
    Geometry slivers;
    for (int i = 0; i < 128 << (2 * detail); ++i) {
        Chance chance(static_cast<std::uint64_t>(i));
        const Vec3 from = chance.point();
        const double length = 1.5 + 0.5 * chance.number();  // in an order that no compiler chooses
        const Vec3 to = from + chance.direction() * length;
        const Vec3 across = normalized(cross(to - from, chance.direction()));
        slivers.add(from, to, from + across * (0.01 / (1 << detail)));
    }
    return slivers;
}

}  // namespace ptb
