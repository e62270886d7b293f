/* `direct`: ray tracing with lamps as areas. Mirrors and glass are followed to the first matte surface, which is lit by one
   lamp, asked at a random point: soft shadows, and no light from matte to matte. */
#define PATH_ASKS
#include "engine/light.h"
#include "engine/work.h"
#include "scene/scatter.h"

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
    gather_lamp(world, path, &surface, matte & (turn + 1u < path->last_turn), (lanes_f)(0.0f), alive COUNTED_ARGUMENT);

    const Vec draw = draw_bounce(&path->random);
    scatter(scene, &path->ray, &path->inside, hit, &surface, &draw COUNTED_ARGUMENT);
    return ends | matte | dies(path, chance_to_go_on(&surface));
}

#define INTEGRATOR direct
#include "engine/trace.h"
#include "engine/kernels.h"
