#include "core/integrator/camera.h"

#include <cmath>
#include <numbers>

namespace ptb {

namespace {

/// Unit axes, and the extent of a pixel and of half the picture at distance 1.
struct PictureFrame {
    Vec3 view, right, down;
    double half_width, half_height, pixel;

    PictureFrame(const Camera& camera, Size size)
        : view(normalized(camera.look_at - camera.position)),
          right(normalized(cross(view, camera.up))),
          down(cross(view, right)),
          half_width(std::tan(camera.fov_deg * std::numbers::pi / 360)),
          half_height(half_width * size.height / size.width),
          pixel(2 * half_width / size.width) {}
};

}  // namespace

ptb_float4 device_vector(const Vec3& v, double w) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

PtbCamera device_camera(const Camera& camera, Size size) {
    const PictureFrame frame(camera, size);
    const Vec3 corner = frame.view - frame.right * frame.half_width - frame.down * frame.half_height;
    return {device_vector(camera.position), device_vector(corner), device_vector(frame.right * frame.pixel),
            device_vector(frame.down * frame.pixel)};
}

PtbPicture device_picture(const Camera& camera, Size size) {
    const PictureFrame frame(camera, size);
    return {device_vector(frame.view, 4 * frame.half_width * frame.half_height),
            device_vector(frame.right * (1 / frame.pixel), size.width / 2.0),
            device_vector(frame.down * (1 / frame.pixel), size.height / 2.0)};
}

}  // namespace ptb
