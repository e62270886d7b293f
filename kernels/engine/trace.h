/* How lanes are kept busy. Every work-item keeps PTB_LANES paths in registers; a lane whose path ended starts the next
   sample at once (path regeneration), and a lane whose unit of samples is done takes the next unit from one queue, so
   lanes stay busy whatever the work-group. A unit's sums depend on its number alone and are added to the film by a second
   kernel: no bit of the image depends on the launch. */
#ifndef PTB_ENGINE_TRACE_H
#define PTB_ENGINE_TRACE_H

#include "engine/unit.h"
#include "engine/cost.h"
#include "engine/work.h"
#ifdef ENGINE_SPLATS
#include "engine/lights.h"
#endif

/* Segments that a lone lane traces before it looks after its paths' ends. On GPUs the lanes of a warp end one by one, and
   all wait while one starts anew: better that the ended ones wait for each other. 1: 3.02, 6: 3.47 Gsamples/s (H200). */
#ifndef ENGINE_BATCH
#define ENGINE_BATCH 1
#endif

/* Every turn traces a segment of every path. */
static inline Traced traced_by(const Path* path, uint turn) {
    Traced traced = traced_nothing();
    traced.segments = (lanes_u)(turn);
    traced.shadow_rays = shadow_rays_of(path);
    return traced;
}

/* What follows a search that is over: the segment to the hit, or the light that was awaited. Returns the lanes whose path ends,
   at this face. */
#if PATH_WAITS

static inline bool arrive(const World* world, Path* path, const Meeting* meeting, bool alive, uint* turn, uint* face COUNTED_PARAMETER) {
    if (meeting->of_shadow_ray) {
        path->shadow.asked = false;
        if (has_seen(meeting COUNTED_ARGUMENT)) {
            COUNTED_LANES(alive, LIGHT_ARRIVES_WORK)
            path->radiance = vec_add(path->radiance, path->awaited);
        }
    } else {
        const Hit hit = end_meeting(world->scene, &path->ray, &path->inside, meeting COUNTED_ARGUMENT);
        *face = hit_face(&hit);
        path->ends = trace_segment(world, path, &hit, alive, *turn COUNTED_ARGUMENT);
        *turn = uint_hold(*turn + 1u);
    }
    return path->ends && !path->shadow.asked;
}

#else

static inline lanes_mask arrive(const World* world, Path* path, const Meeting* meeting, lanes_mask alive, uint* turn,
                                lanes_u* face COUNTED_PARAMETER) {
    const uint stop = uint_hold(min(*turn + ENGINE_BATCH, LANE(path->last_turn, 0)));
    lanes_mask ends;
    do {
        const Hit hit = end_meeting(world->scene, &path->ray, &path->inside, meeting COUNTED_ARGUMENT);
        *face = hit_face(&hit);
        ends = trace_segment(world, path, &hit, alive, *turn COUNTED_ARGUMENT);
        *turn = uint_hold(*turn + 1u);
    } while (ENGINE_BATCH > 1 && *turn < stop && !lanes_any(ends));
    return ends;
}

#endif

/* What only arrivals touch lies in memory meanwhile: with fewer registers more warps search at once (scene/README.md). */
typedef struct Parked {
#if PATH_WAITS
    Vec throughput, radiance, awaited;
#else
    char none;
#endif
} Parked;

static inline void park(const Path* path, Parked* parked) {
#if PATH_WAITS
    parked->throughput = path->throughput;
    parked->radiance = path->radiance;
    parked->awaited = path->awaited;
#else
    (void)path, (void)parked;
#endif
}

static inline void take_up(Path* path, const Parked* parked) {
#if PATH_WAITS
    path->throughput = parked->throughput;
    path->radiance = parked->radiance;
    path->awaited = parked->awaited;
#else
    (void)path, (void)parked;
#endif
}

ENGINE_OUTLINE void trace_units(__global Tally* tallies, __global uint* queues, SCENE_SPHERE_SPACE const SceneSphere* spheres,
                                SCENE_SURFACE_SPACE const SceneSurface* surface_rows, __global const uint* camera_sides,
                                __global const uint* run_starts, __global const SceneLamp* lamps,
                                SCENE_TREE_PARAMETERS EngineLaunch launch ENGINE_SPLATS_PARAMETER COUNTED_PARAMETER) {
    ENGINE_STAY_OUTLINED;
    __global uint* queue = queues + launch.slice;
    const World world = world_of(spheres, surface_rows, lamps, SCENE_TREE_ARGUMENTS &launch);
    const Start start = start_of(&world, surface_rows, camera_sides);
    Unit unit = no_unit();
    Path path = no_path();
    Spare spare = no_spare();
    SPENT_NOTHING
    lanes_mask alive = take_units(&unit, traced_by(&path, 0u), lanes_all(), queue, run_starts, &launch);
    COUNTED_LANES(lanes_all(), ENGINE_TAKE_WORK)
    refill(&spare, &unit, &launch);
    start_spares(&path, &spare, alive, 0u, start, &launch);

    uint turn = 0u;
    MeetingStack waiting;
    ShadowRay shadow = shadow_ray_of(&path);
    Meeting meeting = begin_meeting(world.scene, &path.ray, &path.inside, &shadow, &waiting COUNTED_ARGUMENT);
    Parked parked;
    park(&path, &parked);
    while (lanes_any(alive)) {
#ifdef SCENE_PAUSES
        KEEP_IN_MEMORY(unit); /* as what is parked */
#if PATH_WAITS
        KEEP_IN_MEMORY(parked);
#endif
#endif
        const uint here = meeting_here();
        if (go_on(world.scene, &meeting, &waiting COUNTED_ARGUMENT)) {
            take_up(&path, &parked);
            lanes_u face = (lanes_u)(0u);
            lanes_mask ends = arrive(&world, &path, &meeting, alive, &turn, &face COUNTED_ARGUMENT);
            const lanes_mask full = lanes_hold(turn >= path.last_turn);
            const lanes_mask ended = lanes_meet(lanes_hold(full | ends));
            COUNTED_LANES(alive & ended, ENGINE_PATH_WORK)

            if (lanes_any(ended)) {
                Vec radiance = SAMPLE_SHOWN(&world, &path, face);
                if (PTB_LANES == 1 || lanes_any(full | (ended & !spare.ready))) {
                    const lanes_mask lacking = MASK_OF_MANY(alive & ended & !spare.ready);
                    if (PTB_LANES > 1) add_samples(&unit, spare.radiance, !spare.ready);
                    add_samples(&unit, radiance, lacking);
                    radiance = vec_select(radiance, vec_of((float4)(0.0f)), lacking);
                    spare.radiance = vec_of((float4)(0.0f));
                    unit.counts += lanes_select_u((lanes_u)(0u), (lanes_u)(ENGINE_FULL_LENGTH), full);
                    const lanes_mask finished = lacking & (unit.sample == unit.end);
                    if (lanes_any(finished)) {
                        write_units(&unit, traced_by(&path, turn), finished, tallies);
                        COUNTED_LANES(alive & finished, ENGINE_UNIT_WORK)
                        COUNTED_LANES(alive & finished, ENGINE_TAKE_WORK)
                        if (PTB_LANES == 1) turn = 0u; /* so its unit's first turn needs no register */
                        alive &= !finished | take_units(&unit, traced_by(&path, turn), finished, queue, run_starts, &launch);
                    }
                    refill(&spare, &unit, &launch);
                }
                spare.radiance = vec_select(spare.radiance, radiance, ended);
                start_spares(&path, &spare, ended, turn, start, &launch);
            }
            shadow = shadow_ray_of(&path);
            meeting = begin_meeting(world.scene, &path.ray, &path.inside, &shadow, &waiting COUNTED_ARGUMENT);
            park(&path, &parked);
        }
        meet_again(here);
    }
#ifdef ENGINE_SPLATS
    const Picture picture = picture_of(&launch, start.row->position_side ENGINE_SPLATS_ARGUMENT);
    trace_light_units(&world, &picture, start, queues + launch.light_slice, run_starts, &launch COUNTED_ARGUMENT);
#endif
}

#endif
