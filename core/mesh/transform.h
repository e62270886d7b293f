#pragma once

#include "core/scene/vec3.h"

namespace ptb {

/// How a mesh comes into the world: scaled, turned about x, then about y, then about z, then moved.
struct Transform {
    double scale = 1;  ///< > 0
    Vec3 rotate_deg;   ///< right-handed
    Vec3 translate;    ///< scene units
};

/// A Transform made ready for many points.
class Placing {
  public:
    explicit Placing(const Transform& transform);
    Vec3 operator()(const Vec3& point) const {
        return {dot(rows_[0], point) + translate_.x, dot(rows_[1], point) + translate_.y,
                dot(rows_[2], point) + translate_.z};
    }

  private:
    Vec3 rows_[3];  ///< of the matrix that scales and turns
    Vec3 translate_;
};

}  // namespace ptb
