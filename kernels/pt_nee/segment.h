/* A segment of a path that asks lamps for their light at matte surfaces; what it meets counts by the share that asking leaves. */
#ifndef PTB_PT_NEE_SEGMENT_H
#define PTB_PT_NEE_SEGMENT_H

#include "engine/light.h"
#include "engine/work.h"
#include "scene/scatter.h"

ALWAYS_INLINE lanes_mask trace_asking(const World* world, Path* path, const Hit* hit, lanes_mask alive, uint turn COUNTED_PARAMETER) {
    (void)alive;
    const Scene scene = world->scene;
    const lanes_u face = hit_face(hit);
    const Surface surface = surface_of(&world->surfaces, face);
    const lanes_mask ends = surface.mirrored < 0.0f, matte = surface.mirrored == 0.0f;
    if (SHINE_AND_GO_ON || lanes_any(ends))
        gather_met(world, path, face, share_of_met(world, path, hit, alive COUNTED_ARGUMENT),
                   alive COUNTED_ARGUMENT);
    path->throughput = vec_mul(path->throughput, surface.weight);
    COUNTED_SEGMENT(scene, alive)
    move_to_hit(&path->ray, hit);

    const lanes_f goes_on = chance_to_go_on(&surface);
    gather_lamp(world, path, &surface, matte & (turn + 1u < path->last_turn), goes_on, alive COUNTED_ARGUMENT);

    const Vec draw = draw_bounce(&path->random);
    const lanes_f half_inverse_cosine = scatter(scene, &path->ray, &path->inside, hit, &surface, &draw COUNTED_ARGUMENT);
    COUNTED_LANES(alive, LIGHT_BOUNCE_WORK)
    path->inverse_density = lanes_select((lanes_f)(0.0f), over_chance(2.0f * PI * half_inverse_cosine, goes_on), matte);
    return ends | dies(path, goes_on);
}

#endif
