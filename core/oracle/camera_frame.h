#pragma once

#include <cmath>
#include <numbers>

#include "core/image/image.h"
#include "core/scene/scene.h"

namespace ptb {

/// The camera's unit axes and the half extent of the picture at distance 1.
struct CameraFrame {
    Vec3 forward, right, up;
    double half_width = 1, half_height = 1;

    CameraFrame(const Camera& camera, Size size) {
        forward = normalized(camera.look_at - camera.position);
        right = normalized(cross(forward, camera.up));
        up = cross(right, forward);
        half_width = std::tan(camera.fov_deg / 2 * std::numbers::pi / 180);
        half_height = half_width * size.height / size.width;
    }

    /// From the eye through the picture at `u` and `v` in [0, 1] from its left and top; not of unit length.
    Vec3 toward(double u, double v) const {
        return forward + right * ((2 * u - 1) * half_width) + up * ((1 - 2 * v) * half_height);
    }
};

}  // namespace ptb
