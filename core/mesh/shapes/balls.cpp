#include <array>
#include <cmath>

#include "core/mesh/shapes/shapes.h"

namespace ptb {
namespace {

/// The triangle cut into four, `times` over; `placed` says where each new corner goes.
template <class Placed>
void add_cut(Geometry& geometry, const Vec3& a, const Vec3& b, const Vec3& c, int times,
             const Placed& placed) {
    if (times == 0) return geometry.add(a, b, c);
    const Vec3 ab = placed((a + b) * 0.5), bc = placed((b + c) * 0.5), ca = placed((c + a) * 0.5);
    add_cut(geometry, a, ab, ca, times - 1, placed);
    add_cut(geometry, b, bc, ab, times - 1, placed);
    add_cut(geometry, c, ca, bc, times - 1, placed);
    add_cut(geometry, ab, bc, ca, times - 1, placed);
}

/// The nine balls around one, in a frame whose third axis leads away from what that one sits on.
std::array<Vec3, 9> ways_to_children(const std::array<Vec3, 3>& frame) {
    const double half = 0.5, root = std::sqrt(0.75);
    const std::array<Vec3, 6> around = {
        {{1, 0, 0}, {half, root, 0}, {-half, root, 0}, {-1, 0, 0}, {-half, -root, 0}, {half, -root, 0}}};
    const double out = std::sqrt(1.0 / 3), up = std::sqrt(2.0 / 3);
    const std::array<Vec3, 3> above = {
        {{out * root, out * half, up}, {-out * root, out * half, up}, {0, -out, up}}};
    std::array<Vec3, 9> ways;
    const auto turned = [&](const Vec3& v) { return frame[0] * v.x + frame[1] * v.y + frame[2] * v.z; };
    for (std::size_t i = 0; i < 6; ++i) ways[i] = turned(around[i]);
    for (std::size_t i = 0; i < 3; ++i) ways[6 + i] = turned(above[i]);
    return ways;
}

/// Any frame whose third axis this is.
std::array<Vec3, 3> frame_of(const Vec3& axis) {
    const Vec3 other = std::abs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 first = normalized(cross(other, axis));
    return {first, cross(axis, first), axis};
}

void add_flake(Geometry& flake, const Geometry& ball, const Vec3& centre, double radius, const Vec3& away,
               int generations) {
    const auto corner = [&](std::uint32_t vertex) { return centre + ball.vertices()[vertex] * radius; };
    for (const Face& face : ball.faces()) flake.add(corner(face[0]), corner(face[1]), corner(face[2]));
    if (generations == 0) return;
    for (const Vec3& way : ways_to_children(frame_of(away)))
        add_flake(flake, ball, centre + way * (radius * 4 / 3), radius / 3, way, generations - 1);
}

}  // namespace

Geometry make_box(int detail) {
    Geometry box;
    const auto as_it_is = [](const Vec3& point) { return point; };
    for (const double side : {-1.0, 1.0}) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto corner = [&](double u, double v) {
                const double p[3] = {side, side * u, v};
                return Vec3{p[(3 - axis) % 3], p[(4 - axis) % 3], p[(5 - axis) % 3]};
            };
            add_cut(box, corner(-1, -1), corner(1, -1), corner(1, 1), detail, as_it_is);
            add_cut(box, corner(1, 1), corner(-1, 1), corner(-1, -1), detail, as_it_is);
        }
    }
    return box;
}

Geometry make_sphere(int detail) {
    Geometry sphere;
    const auto on_sphere = [](const Vec3& point) { return normalized(point); };
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) {
                const Vec3 a = {x, 0, 0}, b = {0, y, 0}, c = {0, 0, z};
                if (x * y * z > 0)
                    add_cut(sphere, a, b, c, detail, on_sphere);
                else
                    add_cut(sphere, a, c, b, detail, on_sphere);
            }
    return sphere;
}

Geometry make_flake(int detail) {
    Geometry flake;
    add_flake(flake, make_sphere(detail), {}, 0.5, {0, 1, 0}, 3);
    return flake;
}

}  // namespace ptb
