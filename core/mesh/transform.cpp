#include "core/mesh/transform.h"

#include <cmath>
#include <numbers>

namespace ptb {
namespace {

/// The point of the unit circle at an angle, exact at multiples of a right angle.
struct Turn {
    double cos = 1, sin = 0;

    explicit Turn(double angle_deg) {
        int quadrants = 0;
        const double rest = std::remquo(angle_deg, 90.0, &quadrants) * std::numbers::pi / 180;
        const double c = std::cos(rest), s = std::sin(rest);
        const unsigned quadrant = static_cast<unsigned>(quadrants) % 4;
        cos = quadrant == 0 ? c : quadrant == 1 ? -s : quadrant == 2 ? -c : s;
        sin = quadrant == 0 ? s : quadrant == 1 ? c : quadrant == 2 ? -s : -c;
    }
};

/// Turns what lies in the plane of two rows from the first toward the second.
void turn(Vec3& first, Vec3& second, double angle_deg) {
    const Turn by(angle_deg);
    const Vec3 before = first;
    first = before * by.cos - second * by.sin;
    second = before * by.sin + second * by.cos;
}

}  // namespace

Placing::Placing(const Transform& transform)
    : rows_{{transform.scale, 0, 0}, {0, transform.scale, 0}, {0, 0, transform.scale}},
      translate_(transform.translate) {
    turn(rows_[1], rows_[2], transform.rotate_deg.x);
    turn(rows_[2], rows_[0], transform.rotate_deg.y);
    turn(rows_[0], rows_[1], transform.rotate_deg.z);
}

}  // namespace ptb
