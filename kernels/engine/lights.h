/* How lanes are kept busy with paths that start at lamps: as many as the launch has samples, once lanes find no more of those.
   One ends in a segment or two unless it is of use, so a lane starts the next of its unit at every turn. */
#ifndef PTB_ENGINE_LIGHTS_H
#define PTB_ENGINE_LIGHTS_H

#include "engine/splat.h"
#include "engine/work.h"

/* Starts the next path from a lamp of these lanes' units. */
static inline void start_light_paths(const World* world, Path* path, Unit* unit, lanes_mask fresh, uint turn, const Sides* of_camera,
                                     const EngineLaunch* launch COUNTED_PARAMETER) {
    Path next = no_path();
    Random random = random_of_path(unit->pixel_hash, unit->sample);
    next.random = random_split(&random);
    next.last_turn = (lanes_u)(turn + launch->path_length - 1u); /* the segment to the camera is shown, not traced */
    next.inside = *of_camera;
    leave_lamps(world, &next, fresh COUNTED_ARGUMENT);
    unit->sample += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), fresh);
    path->ray.origin = vec_select(path->ray.origin, next.ray.origin, fresh);
    path->ray.direction = vec_select(path->ray.direction, next.ray.direction, fresh);
    path->throughput = vec_select(path->throughput, next.throughput, fresh);
    path->odds = lanes_select(path->odds, next.odds, fresh);
    path->random = random_select(path->random, next.random, fresh);
    path->last_turn = lanes_select_u(path->last_turn, next.last_turn, fresh);
    path->inside = sides_select(&path->inside, &next.inside, fresh);
#ifdef SCENE_TREE
    if (fresh) path->ray.left = next.ray.left;
#endif
}

ALWAYS_INLINE void trace_light_units(const World* world, const Picture* picture, Start start, __global uint* queue,
                                     __global const uint* run_starts, const EngineLaunch* launch COUNTED_PARAMETER) {
    if (world->lamps.count == 0u || launch->path_length < 3u) return;
    const Sides of_camera = sides_of(start);
    Unit unit = no_unit();
    Path path = no_path();
    Traced traced = traced_nothing();
    lanes_mask busy = take_units(&unit, traced, lanes_all(), queue, run_starts, launch), going = lanes_none();
    COUNTED_LANES(lanes_all(), ENGINE_TAKE_WORK)
    for (uint turn = 0u; lanes_any(busy); ++turn) {
        const lanes_mask fresh = busy & !going;
        if (lanes_any(fresh)) start_light_paths(world, &path, &unit, fresh, turn, &of_camera, launch COUNTED_ARGUMENT);
        going = busy & trace_light_segment(world, picture, &path, fresh, busy, &of_camera, &traced COUNTED_ARGUMENT) &
                (turn + 1u < path.last_turn);
        const lanes_mask finished = busy & !going & (unit.sample == unit.end);
        if (!lanes_any(finished)) continue;
        add_light_rays(picture, &unit, traced, finished, true, launch);
        COUNTED_LANES(finished, ENGINE_TAKE_WORK)
        busy &= !finished | take_units(&unit, traced, finished, queue, run_starts, launch);
    }
}

#endif
