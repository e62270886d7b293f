/* How lanes are kept busy whose samples are more than a path: each lane traces a sample of its unit, all lanes together, and
   one whose unit is done takes the next from the queue. Units and their sums are those of engine/trace.h. */
#ifndef PTB_ENGINE_SAMPLE_H
#define PTB_ENGINE_SAMPLE_H

#include "engine/splat.h"
#include "engine/work.h"
#ifdef ENGINE_GRADIENTS
#include "engine/gradients.h"
#endif

/* Starts the next sample of these lanes' units. */
static inline void start_samples(Path* path, Unit* unit, lanes_mask busy, Start start, const EngineLaunch* launch) {
    Spare spare = no_spare();
    refill(&spare, unit, launch);
    start_spares(path, &spare, busy, 0u, start, launch);
}

ENGINE_OUTLINE void trace_units(__global Tally* tallies, __global uint* queues, SCENE_SPHERE_SPACE const SceneSphere* spheres,
                                SCENE_SURFACE_SPACE const SceneSurface* surface_rows, __global const uint* camera_sides,
                                __global const uint* run_starts, __global const SceneLamp* lamps,
                                SCENE_TREE_PARAMETERS EngineLaunch launch ENGINE_SPLATS_PARAMETER COUNTED_PARAMETER) {
    ENGINE_STAY_OUTLINED;
    __global uint* queue = queues + launch.slice;
    const World world = world_of(spheres, surface_rows, lamps, SCENE_TREE_ARGUMENTS &launch);
    const Start start = start_of(&world, surface_rows, camera_sides);
    const Picture picture = picture_of(&launch, start.row->position_side ENGINE_SPLATS_ARGUMENT);
    Unit unit = no_unit();
    Path path = no_path();
    Traced traced = traced_nothing();
    lanes_mask busy = take_units(&unit, traced, lanes_all(), queue, run_starts, &launch);
    COUNTED_LANES(lanes_all(), ENGINE_TAKE_WORK)
#ifdef ENGINE_GRADIENTS
    GradientSums gradient_sums = no_gradient_sums();
#endif
    while (lanes_any(busy)) {
        start_samples(&path, &unit, busy, start, &launch);
#ifdef ENGINE_GRADIENTS
        Gradients gradients_of_sample;
        const lanes_mask full =
            trace_sample(&world, &picture, &path, busy, unit.place, &gradients_of_sample, &traced COUNTED_ARGUMENT);
        add_gradients(&gradient_sums, &gradients_of_sample, path.radiance, busy);
        COUNTED_LANES(busy, ENGINE_GRADIENTS_WORK)
#else
        const lanes_mask full = trace_sample(&world, &picture, &path, busy, &traced COUNTED_ARGUMENT);
#endif
        COUNTED_LANES(busy, ENGINE_PATH_WORK)
        add_samples(&unit, path.radiance, busy);
        unit.counts += lanes_select_u((lanes_u)(0u), (lanes_u)(ENGINE_FULL_LENGTH), full);
        const lanes_mask finished = busy & (unit.sample == unit.end);
        if (!lanes_any(finished)) continue;
        write_units(&unit, traced, finished, tallies);
#ifdef ENGINE_GRADIENTS
        write_gradients(&picture, &unit, &gradient_sums, finished COUNTED_ARGUMENT);
        clear_gradient_sums(&gradient_sums, finished);
#endif
        add_light_rays(&picture, &unit, traced, finished, false, &launch);
        COUNTED_LANES(finished, ENGINE_UNIT_WORK)
        COUNTED_LANES(finished, ENGINE_TAKE_WORK)
        busy &= !finished | take_units(&unit, traced, finished, queue, run_starts, &launch);
    }
}

#endif
