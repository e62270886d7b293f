/* What a path carries from hit to hit, and the world that it goes through. */
#ifndef PTB_ENGINE_PATH_H
#define PTB_ENGINE_PATH_H

#include "lib/random.h"
#include "scene/surface.h"

/* PATH_GATHERS: a path sums the radiance of what it meets. Where every emitter ends the path, and nothing else gives it
   light, its radiance is only asked for at the end. */
#if defined(SCENE_GLOWS) && !defined(PATH_GATHERS)
#define PATH_GATHERS
#endif

typedef struct Path {
    Ray ray;
    Vec throughput;
#ifdef PATH_GATHERS
    Vec radiance;            /* gathered so far */
    lanes_f inverse_density; /* 1 / density, by solid angle, of the direction that it goes in; 0 where the camera, a mirror or
                                glass left no choice */
    lanes_u shadow_rays;     /* by this lane, ever */
#endif
    Sides inside;
    Random random;
    lanes_u last_turn; /* of the work-item's loop, where every turn traces a segment of every path */
} Path;

static inline Path no_path(void) {
    const Vec zero = vec_of((float4)(0.0f));
    const lanes_u none = (lanes_u)(0u);
    Path path;
    path.ray.origin = path.ray.direction = path.throughput = zero;
#ifdef PATH_GATHERS
    path.radiance = zero;
    path.inverse_density = (lanes_f)(0.0f);
    path.shadow_rays = none;
#endif
    path.random = random_none();
    path.last_turn = none;
    for (uint i = 0; i < SCENE_SIDE_WORDS; ++i) path.inside.word[i] = none;
    return path;
}

static inline lanes_u shadow_rays_of(const Path* path) {
#ifdef PATH_GATHERS
    return path->shadow_rays;
#else
    (void)path;
    return (lanes_u)(0u);
#endif
}

/* What all paths of a work-item go through. */
typedef struct World {
    Scene scene;
    Surfaces surfaces;
    __global const SceneLamp* lamps;
    uint lamp_count;
} World;

#endif
