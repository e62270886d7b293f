/* `whitted`: classical ray tracing. Mirrors and glass are followed to the first matte surface, which is lit by one point of
   each lamp: hard shadows, black where unlit. See "An Improved Illumination Model for Shaded Display", by T. Whitted. */
#include "engine/light.h"
#include "engine/work.h"
#include "scene/scatter.h"

/* The way to the point, its cosine and its side, before it is known to be lit; and its light. */
#define WHITTED_POINT_WORK (3u + 5u + 3u + SCENE_RSQRT_FLOPS + 8u + 5u), SCENE_RSQRT_ROOTS, SCENE_RSQRT_DIVISIONS, 32u
#define WHITTED_LIGHT_WORK 6u, 0u, 1u, 20u
#define WHITTED_FLAT_WORK 6u, 0u, 0u, 20u

/* What a lamp that sends so much at most sends in a direction: triangles send most along their normals. */
static inline lanes_f sent_along(__global const SceneLamp* lamp, Vec direction, lanes_f most COUNTED_PARAMETER) {
    COUNTED_UNUSED
#ifdef SCENE_TREE
    if ((lamp->face & SCENE_TRIANGLE) != 0u) {
        COUNTED(1u, WHITTED_FLAT_WORK)
        return most * fabs(vec_dot(vec_of(lamp->axis_extent), direction));
    }
#endif
    (void)lamp, (void)direction;
    return most;
}

/* Adds the light of the point that stands for a lamp. A cap, which is sunk, sends it to one side alone. */
static inline void gather_point(const World* world, Path* path, const Surface* surface, lanes_mask matte, uint number,
                                lanes_mask counts COUNTED_PARAMETER) {
    (void)counts;
    COUNTED_CENTRES(path->ray, counts & matte)
    COUNTED_LANES(counts & matte, WHITTED_POINT_WORK)
    __global const SceneLamp* lamp = &world->lamps.rows[number];
    const float4 middle_sent = lamp->middle_sent, axis_extent = lamp->axis_extent;
    const Vec to_point = vec_sub(vec_of(middle_sent), path->ray.origin);
    const lanes_f squared = vec_dot(to_point, to_point);
    const lanes_f inverse = lanes_rsqrt(squared);
    const Vec direction = vec_scale(to_point, inverse);
    const lanes_f cosine = vec_dot(matte_normal(path, surface), direction);
    const lanes_mask sent = (lanes_f)(axis_extent.w) >= 2.0f | vec_dot(vec_of(axis_extent), direction) < 0.0f;
    const lanes_mask lit = matte & sent & (cosine > 0.0f);
    if (!lanes_any(lit)) return;
    COUNTED_LANES(counts & lit, WHITTED_LIGHT_WORK)
    const lanes_f sent_there = sent_along(lamp, direction, middle_sent.w * (1.0f / PI) * cosine COUNTED_ARGUMENT);
    const Vec radiance = vec_scale(vec_of(lamp->radiance_kept), sent_there / squared);
    gather_unless_shadowed(world, path, lit, direction, squared * inverse, (lanes_u)(lamp->face), radiance, counts COUNTED_ARGUMENT);
}

static inline lanes_mask trace_segment(const World* world, Path* path, const Hit* hit, lanes_mask alive,
                                       uint turn COUNTED_PARAMETER) {
    (void)alive;
    const Scene scene = world->scene;
    const lanes_u face = hit_face(hit);
    const Surface surface = surface_of(&world->surfaces, face);
    const lanes_mask ends = surface.mirrored < 0.0f, matte = surface.mirrored == 0.0f;
    gather_met(world, path, face, (lanes_f)(1.0f), alive COUNTED_ARGUMENT);
    path->throughput = vec_mul(path->throughput, surface.weight);
    COUNTED_SEGMENT(scene, alive)
    move_to_hit(&path->ray, hit);
    const lanes_mask lit = matte & (turn + 1u < path->last_turn);
    if (lanes_any(lit)) {
        for (uint i = 0; i < world->lamps.count; ++i) gather_point(world, path, &surface, lit, i, alive COUNTED_ARGUMENT);
    }

    const Vec draw = draw_bounce(&path->random);
    scatter(scene, &path->ray, &path->inside, hit, &surface, &draw COUNTED_ARGUMENT);
    return ends | matte | dies(path, chance_to_go_on(&surface));
}

#define INTEGRATOR whitted
#include "engine/trace.h"
#include "engine/kernels.h"
