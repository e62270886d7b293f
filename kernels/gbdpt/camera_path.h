/* The path from the camera, and those shifted from it. */
#ifndef PTB_GBDPT_CAMERA_PATH_H
#define PTB_GBDPT_CAMERA_PATH_H

#include "gbdpt/joins.h"

/* Traces a path from the camera, and those shifted from it, and joins their vertices to the light path's; returns the lanes where it
   is of full length. */
ALWAYS_INLINE lanes_mask trace_from_camera(const World* world, const Picture* picture, Path* path, lanes_mask alive,
                                           const Vertex* light, Gradients* gradients, Traced* traced COUNTED_PARAMETER) {
    const Vec zero = vec_of((float4)(0.0f));
    const lanes_mask all = alive;
    (void)all;
    const lanes_f cosine = vec_dot(path->ray.direction, vec_of(picture->frame.axis_area));
    Odds odds;
    odds.last = inverse_of_picture(picture, cosine);
    odds.earlier = (lanes_f)(0.0f);
    COUNTED_LANES(alive, BDPT_CAMERA_WORK)
    Base base;
    base.prefix = base.shared = zero;
    base.in_chain = alive;
    base.joins = base.joined = lanes_none();
    Offset offsets[NEIGHBOURS];
#pragma unroll 1
    for (uint i = 0; i < NEIGHBOURS; ++i) {
        gradients->toward[i] = zero;
        start_offset(&offsets[i], path,
                     shifted_direction(picture, path->ray.direction, cosine, i, alive COUNTED_ARGUMENT));
    }
    lanes_mask full = lanes_none();
#pragma unroll 1
    for (uint segment = 1u; segment <= ENGINE_PATH_LENGTH; ++segment) {
        if (!lanes_any(alive)) continue;
        const Arrival met = meet(world, path COUNTED_ARGUMENT);
        COUNTED_SEGMENT(world->scene, alive)
        traced->segments += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), alive);
        if (segment == ENGINE_PATH_LENGTH) full = alive;

        Shine shine = no_shine();
        if (SHINE_AND_GO_ON || lanes_any(alive & met.ends))
            shine = shine_of(world, &path->ray, path->throughput, &met, &odds, alive COUNTED_ARGUMENT);
        if (lanes_any(shine.shines & base.in_chain)) {
            COUNTED_LANES(shine.shines & base.in_chain, GBDPT_MET_WORK)
            path->radiance = vec_select(path->radiance, vec_add_scaled(path->radiance, shine.light, (lanes_f)(1.0f)),
                                        shine.shines & base.in_chain);
        }
        const Ray ray = path->ray;
        const Odds before = odds;
        const lanes_f distance = hit_distance(&met.hit);
        const Vertex view = move_to_vertex(path, &met, &odds, odds.last * distance * distance, alive COUNTED_ARGUMENT);

        const lanes_mask joins = base.joins & alive;
        if (lanes_any(joins)) {
#pragma unroll 1
            for (uint i = 0; i < NEIGHBOURS; ++i)
                join_base(world, path, &ray, &met, &view, &before, &shine, &offsets[i], joins, traced COUNTED_ARGUMENT);
            const lanes_mask shines = joins & shine.shines;
            COUNTED_LANES(joins, GBDPT_SHARED_WORK)
            base.shared = vec_select(base.shared, vec_add_scaled(base.shared, shine.light, 1.0f / shine.sum), shines);
            base.joined |= joins;
        }
        add_shared(&base, offsets, shine.light, shine.sum, shine.per_odds, shine.shines & !base.in_chain & !base.joins COUNTED_ARGUMENT);

        const lanes_mask in_chain = base.in_chain & alive, first = in_chain & met.matte;
        COUNTED(BDPT_ENDS == 2 && two_sided_spheres(world->scene) > 0u ? counted_lanes(alive) : 0u, GBDPT_SQUEEZED_WORK)
        alive = bounce(world, path, &met, &odds, false, alive COUNTED_ARGUMENT);
        const lanes_mask through = sides_differ(&view.inside, &path->inside);
        if (BDPT_ENDS == 2 && two_sided_spheres(world->scene) > 0u) {
            const lanes_f squeezed = squeezed_by(&met.surface, path, &view.inside);
            for (uint i = 0; i < NEIGHBOURS; ++i) offsets[i].odds = offsets[i].odds * squeezed;
        }
        if (lanes_any(in_chain)) {
            COUNTED_LANES(in_chain, GBDPT_ALONG_WORK)
            const Vec outwards = vec_sub(view.position, met.surface.centre);
            const lanes_f chance = chance_of(&met, vec_dot(ray.direction, outwards), through, in_chain COUNTED_ARGUMENT);
#pragma unroll 1
            for (uint i = 0; i < NEIGHBOURS; ++i)
                follow(world, picture, &offsets[i], &gradients->toward[i], &met, &shine, through, chance, segment, in_chain,
                       traced COUNTED_ARGUMENT);
        }
        if (segment < ENGINE_PATH_LENGTH) ask_shifted(world, path, &view, &base, offsets, gradients, first, traced COUNTED_ARGUMENT);
#pragma unroll 1
        for (uint i = 0u; BDPT_ENDS == 2 && segment + i + 1u < ENGINE_PATH_LENGTH; ++i)
            join_shifted(world, path, &view, &light[i], &base, offsets, gradients, first, traced COUNTED_ARGUMENT);

        base.prefix = vec_select(base.prefix, path->throughput, first);
        path->throughput = vec_select(path->throughput, vec_of((float4)(1.0f)), first & alive);
        base.in_chain &= alive & !met.matte;
        base.joins = first & alive;
    }
    COUNTED_LANES(all, GBDPT_END_WORK)
    path->radiance = vec_mul_add(path->radiance, base.prefix, base.shared);
    for (uint i = 0; i < NEIGHBOURS; ++i) {
        const Vec shared = vec_mul_add(gradients->toward[i], vec_sub(offsets[i].throughput, base.prefix), offsets[i].place);
        gradients->toward[i] = vec_select(gradients->toward[i], shared, base.joined);
    }
    return full;
}

#endif
