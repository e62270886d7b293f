#pragma once

#include <string>

#include "core/scene/scene.h"

namespace ptb {

/// A scene of configs/scenes.
Scene shipped_scene(const std::string& name);

/// The camera in a glass ball, which is in a matte room with a light.
Scene camera_in_glass();

/// Three glass balls of different indices, each in the next.
Scene nested_glass();

/// `count` glass balls before a bright dome, so `count` side bits a path.
Scene glass_balls(int count);

/// `count` balls that do not touch, on a jittered grid, of all materials with several emitters, in a dim
/// dome.
Scene mixed_balls(int count);

}  // namespace ptb
