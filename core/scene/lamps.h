#pragma once

#include <vector>

#include "core/scene/alias_table.h"
#include "core/scene/scene.h"

namespace ptb {

/// How much of a lamp shows: all of it, or the cap that an opaque sphere leaves.
enum class LampKind { free, cap };

/// A sphere that can light others. What of it an opaque sphere keeps from every path does not count: what is
/// inside of that sphere, or what is outside if the camera is inside. Of several such spheres the one that
/// hides most makes the cap; points that others hide are wasted on, not wrong.
struct Lamp {
    int sphere = 0;  ///< index into Scene::spheres
    LampKind kind = LampKind::free;
    Vec3 axis;                   ///< of a cap: unit length, from the lamp's centre to the cap's middle
    double cos_rim = -1;         ///< of the angle between axis and rim; -1 is the whole sphere
    double area = 0;             ///< of what shows
    double power = 0;            ///< area x pi x the mean of the radiance's channels
    bool around_camera = false;  ///< its inner face is seen from there, and it lights nothing else
};

/// Lamps in the order of their spheres, and how to choose among them by power. Those around the camera are
/// never chosen. The channels weigh the same since each is validated by itself: by luminance a blue lamp
/// would seldom be chosen, and blue be noisy.
struct Lamps {
    std::vector<Lamp> lamps;
    AliasTable choice;  ///< of an index into `lamps`; empty where none can be chosen
};

/// Spheres that glow and of which something shows. Time: lamps times spheres.
Lamps find_lamps(const Scene& scene);

}  // namespace ptb
