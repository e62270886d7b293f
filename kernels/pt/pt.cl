/* `pt`: the physically right path tracer. Every work-item keeps PTB_LANES paths in registers; a lane whose path ended
   starts the next sample at once (path regeneration), and a lane whose unit of samples is done takes the next unit from
   one queue, so lanes stay busy whatever the work-group. A unit's sums depend on its number alone and are added to the
   film in the order of their numbers by a second kernel: no bit of the image depends on the launch. */
#include "pt/scatter.h"
#include "pt/unit.h"

/* PoCL stores every variable of a kernel's loop to memory at each turn, but not those of a function that it may not
   inline: 10.3 -> 11.7 Msamples/s (two AVX-512 cores). */
#if PTB_LANES > 1
#define PT_OUTLINE static __attribute__((noinline))
#else
#define PT_OUTLINE static inline
#endif

/* Segments that a lone lane traces before it looks after its paths' ends. On GPUs the lanes of a warp end one by one, and
   all wait while one starts anew: better that the ended ones wait for each other. 1: 3.02, 6: 3.47 Gsamples/s (H200). */
#ifndef PT_BATCH
#define PT_BATCH 1
#endif

PT_OUTLINE void trace_units(__global PtTally* tallies, __global uint* queue, PT_SPHERE_SPACE const PtSphere* spheres,
                            PT_SURFACE_SPACE const PtSurface* surface_rows, Start start, PtLaunch launch) {
#ifdef PT_FEW
    const Scene scene = {spheres, PT_OPAQUE, PT_FEW, launch.distance_mask};
#else
    const Scene scene = {spheres, launch.opaque_spheres, launch.opaque_spheres + launch.two_sided_spheres, 0u};
#endif
    Unit unit = no_unit();
    Path path = no_path();
    Spare spare = no_spare();
    lanes_mask alive = take_units(&unit, lanes_all(), 0u, queue, &launch);
    refill(&spare, &unit, &launch);
    start_spares(&path, &spare, alive, 0u, start, &launch);
    const Surfaces surfaces = surfaces_of(surface_rows, scene.count);

    uint turn = 0u;
    while (lanes_any(alive)) {
        lanes_u sphere;
        lanes_mask full, ended;
        uint batch = PT_BATCH;
        do {
            const Hit hit = nearest_hit(scene, &path.ray, &path.inside);
            sphere = hit_sphere(&hit);
            const Surface surface = surface_of(&surfaces, sphere);
            gather_radiance(&path, &surfaces, sphere);
            path.throughput = vec_mul(path.throughput, surface.weight);
            scatter(&path.ray, &path.inside, &hit, &surface, &path.random);
            turn += 1u;
            full = turn >= path.last_turn;
            ended = full | (surface.ends > 0.0f);
            batch -= 1u;
        } while (batch > 0u && !lanes_any(ended));
        ended = lanes_meet(ended);

        if (PTB_LANES > 1 || lanes_any(ended)) {
            Vec radiance = gathered_radiance(&path, &surfaces, sphere);
            if (PTB_LANES == 1 || lanes_any(full | (ended & !spare.ready))) {
                const lanes_mask lacking = MASK_OF_MANY(alive & ended & !spare.ready);
                add_samples(&unit, spare.radiance, !spare.ready);
                add_samples(&unit, radiance, lacking);
                radiance = vec_select(radiance, vec_of((float4)(0.0f)), lacking);
                spare.radiance = vec_of((float4)(0.0f));
                unit.full_length_paths += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), full);
                const lanes_mask finished = lacking & (unit.sample == unit.end);
                if (lanes_any(finished)) {
                    write_units(&unit, finished, turn, tallies);
                    alive &= !finished | take_units(&unit, finished, turn, queue, &launch);
                    }
                refill(&spare, &unit, &launch);
            }
            spare.radiance = vec_select(spare.radiance, radiance, ended);
            start_spares(&path, &spare, ended, turn, start, &launch);
        }
    }
}

__kernel void pt_render(__global PtTally* tallies, __global uint* queue, PT_SCENE_SPACE const PtSphere* spheres,
                        PT_SCENE_SPACE const PtSurface* surfaces, __global const uint* camera_sides,
                        const PtFewSpheres few, const PtLaunch launch) {
#ifdef PT_FEW
    PT_SPHERE_SPACE const PtSphere* all = few.sphere;
    (void)spheres;
#else
    PT_SPHERE_SPACE const PtSphere* all = spheres;
#endif
    const Start start = {camera_sides, few.camera_gap};
#ifdef PT_LOCAL_SURFACES
    __local PtSurface rows[PT_FEW + 1];
    for (uint i = (uint)get_local_id(0); i <= PT_FEW; i += (uint)get_local_size(0)) rows[i] = surfaces[i];
    barrier(CLK_LOCAL_MEM_FENCE);
#else
    PT_SCENE_SPACE const PtSurface* rows = surfaces;
#endif
    trace_units(tallies, queue, all, rows, start, launch);
}

/* Adds the tallies of one launch to the film, a pixel a work-item, in the order of the units. */
__kernel void pt_add(__global PtTally* film, __global const PtTally* tallies, const PtLaunch launch) {
    const uint pixel = (uint)get_global_id(0);
    if (pixel >= launch.pixels) return;
    PtTally sum = film[launch.first_pixel + pixel];
    for (uint unit = pixel; unit < launch.units; unit += launch.pixels) {
        const PtTally tally = tallies[unit];
        sum.radiance += tally.radiance;
        sum.squares += tally.squares;
        sum.samples += tally.samples;
        sum.segments += tally.segments;
        sum.full_length_paths += tally.full_length_paths;
    }
    film[launch.first_pixel + pixel] = sum;
}
