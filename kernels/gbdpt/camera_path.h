/* The path from the camera, and those shifted from it. */
#ifndef PTB_GBDPT_CAMERA_PATH_H
#define PTB_GBDPT_CAMERA_PATH_H

#include "gbdpt/joins.h"

/* A camera path on its way, and those shifted from it. */
typedef struct CameraPath {
    Odds odds;
    Vertex view;      /* the last one, of lanes in `first` the first matte one */
    lanes_u segments; /* so far */
    lanes_mask first; /* the lanes that have come to a matte vertex, */
    lanes_mask alive; /* those of them whose path goes on, */
    lanes_mask full;  /* and those where a path is of full length */
    Base base;
    Offset offsets[NEIGHBOURS];
} CameraPath;

static inline lanes_u one_in(lanes_mask mask) { return lanes_select_u((lanes_u)(0u), (lanes_u)(1u), mask); }

/* A lone lane that has nothing to trace does not come here. */
static inline Path path_select(const Path* if_false, const Path* if_true, lanes_mask mask) {
    Path path = *if_true;
    if (PTB_LANES == 1) return path;
    path.ray.origin = vec_select(if_false->ray.origin, if_true->ray.origin, mask);
    path.ray.direction = vec_select(if_false->ray.direction, if_true->ray.direction, mask);
    path.throughput = vec_select(if_false->throughput, if_true->throughput, mask);
    path.radiance = vec_select(if_false->radiance, if_true->radiance, mask);
    path.inside = sides_select(&if_false->inside, &if_true->inside, mask);
    path.random = random_select(if_false->random, if_true->random, mask);
    return path;
}

static inline void start_camera_path(const Picture* picture, const Path* path, lanes_mask alive, CameraPath* camera,
                                     Gradients* gradients COUNTED_PARAMETER) {
    const Vec zero = vec_of((float4)(0.0f));
    const lanes_f cosine = vec_dot(path->ray.direction, vec_of(picture->frame.axis_area));
    COUNTED_LANES(alive, BDPT_CAMERA_WORK)
    camera->odds.last = inverse_of_picture(picture, cosine);
    camera->odds.earlier = (lanes_f)(0.0f);
    camera->view = no_vertex(&path->inside);
    camera->segments = (lanes_u)(0u);
    camera->first = camera->alive = camera->full = lanes_none();
    camera->base.prefix = camera->base.shared = zero;
#pragma unroll 1
    for (uint i = 0; i < NEIGHBOURS; ++i) {
        gradients->toward[i] = zero;
        start_offset(&camera->offsets[i], path,
                     shifted_direction(picture, path->ray.direction, cosine, i, alive COUNTED_ARGUMENT));
    }
}

/* Through mirrors and glass to the first matte vertex. Lanes that are there wait for the others, since what comes then is the
   most work: by all at once it takes their time once, not at every turn of the loop. */
ALWAYS_INLINE void trace_chain(const World* world, const Picture* picture, Path* path, lanes_mask in_chain, CameraPath* camera,
                               Gradients* gradients, Traced* traced COUNTED_PARAMETER) {
#pragma unroll 1
    for (uint segment = 1u; segment <= ENGINE_PATH_LENGTH; ++segment) {
        if (!lanes_any(in_chain)) continue;
        Path moved = *path;
        Odds odds = camera->odds;
        const Arrival met = meet(world, &moved COUNTED_ARGUMENT);
        COUNTED_SEGMENT(world->scene, in_chain)
        traced->segments += one_in(in_chain);
        camera->segments += one_in(in_chain);
        if (segment == ENGINE_PATH_LENGTH) camera->full = in_chain;

        Shine shine = no_shine();
        if (SHINE_AND_GO_ON || lanes_any(in_chain & met.ends))
            shine = shine_of(world, &moved.ray, moved.throughput, &met, &odds, in_chain COUNTED_ARGUMENT);
        if (lanes_any(shine.shines)) {
            COUNTED_LANES(shine.shines, GBDPT_MET_WORK)
            moved.radiance = vec_select(moved.radiance, vec_add_scaled(moved.radiance, shine.light, (lanes_f)(1.0f)), shine.shines);
        }
        const Vec direction = moved.ray.direction;
        const lanes_f distance = hit_distance(&met.hit);
        const Vertex vertex = move_to_vertex(&moved, &met, &odds, odds.last * distance * distance, in_chain COUNTED_ARGUMENT);
        const lanes_mask goes_on = bounce(world, &moved, &met, &odds, false, in_chain COUNTED_ARGUMENT);

        COUNTED_LANES(in_chain, GBDPT_ALONG_WORK)
        const lanes_mask through = sides_differ(&vertex.inside, &moved.inside);
        const Vec outwards = vec_sub(vertex.position, met.surface.centre);
        const lanes_f chance = chance_of(&met, vec_dot(direction, outwards), through, in_chain COUNTED_ARGUMENT);
#pragma unroll 1
        for (uint i = 0; i < NEIGHBOURS; ++i)
            follow(world, picture, &camera->offsets[i], &gradients->toward[i], &met, &shine, through, chance, segment, in_chain,
                   traced COUNTED_ARGUMENT);

        Random next = moved.random;
        (void)draw_lamp(&next); /* which mirrors and glass do not ask */
        moved.random = random_select(moved.random, next, !met.matte);
        *path = path_select(path, &moved, in_chain);
        camera->odds.last = lanes_select(camera->odds.last, odds.last, in_chain);
        camera->odds.earlier = lanes_select(camera->odds.earlier, odds.earlier, in_chain);
        camera->view = vertex_select(&camera->view, &vertex, in_chain);
        const lanes_mask first = in_chain & met.matte;
        camera->first |= first;
        camera->alive |= first & goes_on;
        in_chain = goes_on & !met.matte;
    }
}

/* Joins the first matte vertex to lamps and to the light path, and so those of the shifted paths. */
ALWAYS_INLINE void join_first_vertex(const World* world, Path* path, CameraPath* camera, const Vertex* light, Gradients* gradients,
                                     Traced* traced COUNTED_PARAMETER) {
    ask_at_first(world, path, &camera->view, camera->offsets, gradients, camera->segments < ENGINE_PATH_LENGTH, traced COUNTED_ARGUMENT);
#pragma unroll 1
    for (uint i = 0u; BDPT_ENDS == 2 && i + 2u < ENGINE_PATH_LENGTH; ++i)
        join_at_first(world, path, &camera->view, &light[i], camera->offsets, gradients,
                      camera->segments + i + 1u < ENGINE_PATH_LENGTH, traced COUNTED_ARGUMENT);
    camera->base.prefix = vec_select(camera->base.prefix, path->throughput, camera->first);
    path->throughput = vec_select(path->throughput, vec_of((float4)(1.0f)), camera->alive);
}

/* Traces the rest of the path, whose light shifted paths share from its next vertex on, where they join it. */
ALWAYS_INLINE void trace_shared(const World* world, Path* path, CameraPath* camera, const Vertex* light, Traced* traced COUNTED_PARAMETER) {
    lanes_mask alive = camera->alive;
#pragma unroll 1
    for (uint turn = 1u; turn < ENGINE_PATH_LENGTH; ++turn) {
        alive &= camera->segments < ENGINE_PATH_LENGTH;
        if (!lanes_any(alive)) continue;
        const Arrival met = meet(world, path COUNTED_ARGUMENT);
        COUNTED_SEGMENT(world->scene, alive)
        traced->segments += one_in(alive);
        camera->segments += one_in(alive);
        camera->full |= alive & (camera->segments == ENGINE_PATH_LENGTH);

        Shine shine = no_shine();
        if (SHINE_AND_GO_ON || lanes_any(alive & met.ends))
            shine = shine_of(world, &path->ray, path->throughput, &met, &camera->odds, alive COUNTED_ARGUMENT);
        const Ray ray = path->ray;
        const Odds before = camera->odds;
        const lanes_f distance = hit_distance(&met.hit);
        const Vertex view =
            move_to_vertex(path, &met, &camera->odds, before.last * distance * distance, alive COUNTED_ARGUMENT);

        if (turn == 1u) {
#pragma unroll 1
            for (uint i = 0; i < NEIGHBOURS; ++i)
                join_base(world, path, &ray, &met, &view, &before, &shine, &camera->offsets[i], alive, traced COUNTED_ARGUMENT);
            COUNTED_LANES(alive, GBDPT_SHARED_WORK)
            camera->base.shared = vec_select(camera->base.shared, vec_add_scaled(camera->base.shared, shine.light, 1.0f / shine.sum),
                                             alive & shine.shines);
        } else {
            add_shared(&camera->base, camera->offsets, shine.light, shine.sum, shine.per_odds, shine.shines COUNTED_ARGUMENT);
        }

        COUNTED(BDPT_ENDS == 2 && two_sided_spheres(world->scene) > 0u ? counted_lanes(alive) : 0u, GBDPT_SQUEEZED_WORK)
        alive = bounce(world, path, &met, &camera->odds, false, alive COUNTED_ARGUMENT);
        if (BDPT_ENDS == 2 && two_sided_spheres(world->scene) > 0u) {
            const lanes_f squeezed = squeezed_by(&met.surface, path, &view.inside);
            for (uint i = 0; i < NEIGHBOURS; ++i) camera->offsets[i].odds = camera->offsets[i].odds * squeezed;
        }
        ask_beyond(world, path, &view, &camera->base, camera->offsets, camera->segments < ENGINE_PATH_LENGTH, traced COUNTED_ARGUMENT);
#pragma unroll 1
        for (uint i = 0u; BDPT_ENDS == 2 && turn + i + 2u < ENGINE_PATH_LENGTH; ++i)
            join_beyond(world, &view, &light[i], &camera->base, camera->offsets, camera->segments + i + 1u < ENGINE_PATH_LENGTH,
                        traced COUNTED_ARGUMENT);
    }
}

/* Traces a path from the camera, and those shifted from it, and joins their vertices to the light path's; returns the lanes where it
   is of full length. */
ALWAYS_INLINE lanes_mask trace_from_camera(const World* world, const Picture* picture, Path* path, lanes_mask alive,
                                           const Vertex* light, Gradients* gradients, Traced* traced COUNTED_PARAMETER) {
    CameraPath camera;
    start_camera_path(picture, path, alive, &camera, gradients COUNTED_ARGUMENT);
    trace_chain(world, picture, path, alive, &camera, gradients, traced COUNTED_ARGUMENT);
    join_first_vertex(world, path, &camera, light, gradients, traced COUNTED_ARGUMENT);
    trace_shared(world, path, &camera, light, traced COUNTED_ARGUMENT);

    COUNTED_LANES(alive, GBDPT_END_WORK)
    const Base* base = &camera.base;
    path->radiance = vec_mul_add(path->radiance, base->prefix, base->shared);
    for (uint i = 0; i < NEIGHBOURS; ++i)
        gradients->toward[i] = vec_mul_add(gradients->toward[i], vec_sub(camera.offsets[i].weight, base->prefix), camera.offsets[i].shared);
    return camera.full;
}

#endif
