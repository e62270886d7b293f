#pragma once

#include "core/image/image.h"
#include "core/scene/scene.h"
#include "shared/camera.h"

namespace ptb {

/// The scene's camera as kernels want it, for an image of this size.
PtbCamera device_camera(const Camera& camera, Size size);

/// The same camera's way back from directions to pixels.
PtbPicture device_picture(const Camera& camera, Size size);

/// Three doubles as a device vector, rounded once.
ptb_float4 device_vector(const Vec3& v, double w = 0);

}  // namespace ptb
