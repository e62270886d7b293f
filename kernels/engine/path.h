/* What a path carries from hit to hit, and the world that it goes through. */
#ifndef PTB_ENGINE_PATH_H
#define PTB_ENGINE_PATH_H

#include "scene/lamps.h"
#include "scene/meet.h"

/* PATH_GATHERS: a path sums the radiance of what it meets. Where every emitter ends the path, and nothing else gives it
   light, its radiance is only asked for at the end. */
#if defined(SCENE_GLOWS) && !defined(PATH_GATHERS)
#define PATH_GATHERS
#endif

/* Whether an emitter may scatter paths on, so that any segment may meet one. */
#ifdef SCENE_GLOWS
#define SHINE_AND_GO_ON 1
#else
#define SHINE_AND_GO_ON 0
#endif

/* PATH_ASKS: a path asks one lamp at a hit, at most. With SCENE_PAUSES the shadow ray goes its way as any ray does. */
#if defined(PATH_ASKS) && defined(SCENE_PAUSES)
#define PATH_WAITS 1
#else
#define PATH_WAITS 0
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
#if PATH_WAITS
    ShadowRay shadow;
    Vec awaited; /* radiance by way of the shadow ray */
    bool ends;   /* when the shadow ray has */
#endif
#ifdef PATH_ODDS
    lanes_f odds; /* of other strategies that make the same path, as its integrator keeps them; below 0 of a camera's ray */
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
#if PATH_WAITS
    path.shadow.asked = path.ends = false;
    path.awaited = zero;
#endif
#ifdef PATH_ODDS
    path.odds = (lanes_f)(-1.0f);
#endif
    path.random = random_none();
    path.last_turn = none;
    for (uint i = 0; i < SCENE_SIDE_WORDS; ++i) path.inside.word[i] = none;
#ifdef SCENE_TREE
    path.ray.left = TREE_NOTHING;
#endif
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

/* None is asked but by paths that wait. */
static inline ShadowRay shadow_ray_of(const Path* path) {
#if PATH_WAITS
    return path->shadow;
#else
    const ShadowRay none = {0};
    (void)path;
    return none;
#endif
}

/* What all paths of a work-item go through. */
typedef struct World {
    Scene scene;
    Surfaces surfaces;
    Lamps lamps;
    const PtbPicture* frame;
} World;

/* Russian roulette, with ENGINE_ROULETTE: a path goes on from a surface with the mean of what the surface reflects as its
   chance, and weighs more then. Else with certainty. */
static inline lanes_f chance_to_go_on(const Surface* surface) {
#ifdef ENGINE_ROULETTE
    return lanes_min((surface->weight.x + surface->weight.y + surface->weight.z) * (1.0f / 3.0f), (lanes_f)(1.0f));
#else
    (void)surface;
    return (lanes_f)(1.0f);
#endif
}

/* A number of those that go on. Of a surface that reflects nothing none do, and what they weigh stays a number. */
static inline lanes_f over_chance(lanes_f x, lanes_f chance) {
#ifdef ENGINE_ROULETTE
    return x / lanes_max(chance, (lanes_f)(1e-20f));
#else
    (void)chance;
    return x;
#endif
}

/* The lanes whose path does not go on. */
static inline lanes_mask dies(Path* path, lanes_f chance) {
#ifdef ENGINE_ROULETTE
    lanes_u u, v;
    random_next_two(&path->random, &u, &v);
    path->throughput = vec_scale(path->throughput, over_chance((lanes_f)(1.0f), chance));
    return random_1_2(u) - 1.0f >= chance;
#else
    (void)path, (void)chance;
    return lanes_none();
#endif
}

#endif
