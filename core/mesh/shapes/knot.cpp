#include <cstddef>
#include <vector>

#include "core/mesh/shapes/shapes.h"

namespace ptb {
namespace {

/// 4 x 2^halvings points of the unit circle in x and y, from (1, 0) on; each halving puts one between two.
class Circle {
  public:
    explicit Circle(int halvings) {
        for (int i = 0; i < halvings; ++i) {
            std::vector<Vec3> finer;
            for (std::size_t k = 0; k < points_.size(); ++k) {
                finer.push_back(points_[k]);
                finer.push_back(normalized(points_[k] + at(k + 1)));
            }
            points_ = finer;
        }
    }
    std::size_t count() const { return points_.size(); }
    const Vec3& at(std::size_t i) const { return points_[i % points_.size()]; }

  private:
    std::vector<Vec3> points_ = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
};

constexpr double torus_radius = 0.6, winding_radius = 0.3, tube_radius = 0.1;

/// Middle of the torus' own tube, and a point of the knot, at a part of the way.
Vec3 on_torus(const Circle& whole, std::size_t i) { return whole.at(2 * i) * torus_radius; }
Vec3 on_knot(const Circle& whole, std::size_t i) {
    const Vec3 outwards = whole.at(2 * i), winding = whole.at(3 * i);
    return on_torus(whole, i) + outwards * (winding_radius * winding.x) +
           Vec3{0, 0, winding_radius * winding.y};
}

/// The tube's corners around a point of the knot.
std::vector<Vec3> ring(const Circle& whole, const Circle& around, std::size_t i) {
    const Vec3 middle = on_knot(whole, i);
    const Vec3 ahead = normalized(on_knot(whole, i + 1) - on_knot(whole, i + whole.count() - 1));
    const Vec3 away = middle - on_torus(whole, i);
    const Vec3 first = normalized(away - ahead * dot(ahead, away)), second = cross(ahead, first);
    std::vector<Vec3> corners;
    for (std::size_t k = 0; k < around.count(); ++k)
        corners.push_back(middle + (first * around.at(k).x + second * around.at(k).y) * tube_radius);
    return corners;
}

}  // namespace

Geometry make_knot(int detail) {
    const Circle whole(4 + detail), around(1 + detail);
    Geometry knot;
    std::vector<Vec3> here = ring(whole, around, 0);
    for (std::size_t i = 1; i <= whole.count(); ++i) {
        const std::vector<Vec3> next = ring(whole, around, i % whole.count());
        for (std::size_t k = 0; k < around.count(); ++k) {
            const std::size_t other = (k + 1) % around.count();
            knot.add(here[k], here[other], next[other]);
            knot.add(next[other], next[k], here[k]);
        }
        here = next;
    }
    return knot;
}

}  // namespace ptb
