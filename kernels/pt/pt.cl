/* `pt`: the physically right path tracer. A path gathers what emitters it meets send back along it, and nothing else. */
#include "engine/path.h"
#include "engine/work.h"
#include "scene/scatter.h"

/* Adds what a path meets; an emitter that ends paths has weight 1. */
static inline void gather_radiance(Path* path, const Surfaces* surfaces, lanes_u face) {
#ifdef PATH_GATHERS
    path->radiance = vec_mul_add(path->radiance, path->throughput, radiance_of(surfaces, face));
#else
    (void)path, (void)surfaces, (void)face;
#endif
}

/* What a path that ended at this face is worth. */
static inline Vec gathered_radiance(const World* world, const Path* path, lanes_u face) {
#ifdef PATH_GATHERS
    (void)world, (void)face;
    return path->radiance;
#else
    return vec_mul(path->throughput, radiance_of(&world->surfaces, face));
#endif
}

/* One segment of every path: to the nearest face, which scatters it. Returns the lanes whose path ends there. */
static inline lanes_mask trace_segment(const World* world, Path* path, const Hit* hit, lanes_mask alive,
                                       uint turn COUNTED_PARAMETER) {
    (void)alive, (void)turn;
    const Scene scene = world->scene;
    const Vec draw = draw_bounce(&path->random);
    const lanes_u face = hit_face(hit);
    const Surface surface = surface_of(&world->surfaces, face);
    gather_radiance(path, &world->surfaces, face);
    const lanes_mask ends = lanes_hold(surface.mirrored < 0.0f); /* as a mask at once: 0.98 -> 1 (two AVX-512 cores) */
    path->throughput = vec_mul(path->throughput, surface.weight);
    COUNTED_SEGMENT(scene, alive)
    COUNTED_LANES(alive, ENGINE_GATHER_WORK)
    move_to_hit(&path->ray, hit);
    scatter(scene, &path->ray, &path->inside, hit, &surface, &draw COUNTED_ARGUMENT);
    return ends | dies(path, chance_to_go_on(&surface));
}

#define INTEGRATOR pt
#include "engine/trace.h"
#include "engine/kernels.h"
