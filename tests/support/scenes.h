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

/// Balls of all materials, none of which cuts another, in a dim dome; the camera is among them, or in a glass
/// one.
Scene random_balls(unsigned seed, bool camera_in_glass);

/// The same scene in another unit of length and from another origin.
Scene moved(const Scene& scene, double scale, const Vec3& by);

/// Balls before a bright sky, `distance` from the camera and from one more ball, which it does not see.
Scene balls_far_apart(double distance);

/// Balls of radius 1 at a wall of this radius that is flat to the eye, under a lamp, before a bright sky: the
/// wall is matte, or the surface of water that they lie under, or the room itself.
Scene balls_at_a_wall(double radius, const std::string& wall);

/// A closed room of triangles with meshes in it: a lamp, a ball of glass and a mirror, all cut in pieces, and
/// a sphere of glass and a matte one. The camera is inside.
Scene mesh_room();

/// One triangle that shines, before the camera.
Scene lone_triangle();

/// A closed room of needles, two for each of `strips` strips of a wall, that all shine and scatter on.
Scene needle_room(int strips);

}  // namespace ptb
