#include "core/integrator/camera.h"

#include <cmath>
#include <numbers>

namespace ptb {

ptb_float4 device_vector(const Vec3& v, double w) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

PtbCamera device_camera(const Camera& camera, Size size) {
    const Vec3 view = normalized(camera.look_at - camera.position);
    const Vec3 right = normalized(cross(view, camera.up));
    const Vec3 down = cross(view, right);
    const double half_width = std::tan(camera.fov_deg * std::numbers::pi / 360);
    const double pixel = 2 * half_width / size.width;
    const Vec3 corner = view - right * half_width - down * (pixel * size.height / 2);
    return {device_vector(camera.position), device_vector(corner), device_vector(right * pixel),
            device_vector(down * pixel)};
}

}  // namespace ptb
