#include "core/mesh/shapes.h"

#include <functional>

namespace ptb {
namespace {

/// The triangle cut into four, `times` over; of each new corner `placed` says where it goes.
void add_cut(Geometry& geometry, const Vec3& a, const Vec3& b, const Vec3& c, int times,
             const std::function<Vec3(const Vec3&)>& placed) {
    if (times == 0) return geometry.add(a, b, c);
    const Vec3 ab = placed((a + b) * 0.5), bc = placed((b + c) * 0.5), ca = placed((c + a) * 0.5);
    add_cut(geometry, a, ab, ca, times - 1, placed);
    add_cut(geometry, b, bc, ab, times - 1, placed);
    add_cut(geometry, c, ca, bc, times - 1, placed);
    add_cut(geometry, ab, bc, ca, times - 1, placed);
}

/// The cube from -1 to 1, each face 2 x 4^detail triangles.
Geometry make_box(int detail) {
    Geometry box;
    const auto as_it_is = [](const Vec3& point) { return point; };
    for (const double side : {-1.0, 1.0}) {
        for (int axis = 0; axis < 3; ++axis) {
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

/// The unit sphere: an octahedron whose 8 x 4^detail triangles have their corners on it.
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

}  // namespace

const std::vector<Shape>& shapes() {
    static const std::vector<Shape> all = {{"box", 9, make_box}, {"sphere", 10, make_sphere}};
    return all;
}

}  // namespace ptb
