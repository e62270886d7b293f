/* `pt`: the physically right path tracer. Every work-item keeps PTB_LANES paths in registers; a lane whose path ended
   starts the next sample at once (path regeneration), and a lane whose unit of samples is done takes the next unit from
   one queue, so lanes stay busy whatever the work-group. A unit's sums depend on its number alone and are added to the
   film in the order of their numbers by a second kernel: no bit of the image depends on the launch. */
#include "lib/outlined.h"
#include "pt/scatter.h"
#include "pt/unit.h"
#include "pt/work.h"

/* One lane a work-item keeps its loop in the kernel. A function that reads local memory PoCL compiles to a crash (3.1). */
#if PTB_LANES > 1 && PT_SPHERES != PT_IN_LOCAL && PT_SURFACES != PT_IN_LOCAL
#define PT_OUTLINE OUTLINED
#define PT_STAY_OUTLINED STAY_OUTLINED
#else
#define PT_OUTLINE static inline
#define PT_STAY_OUTLINED (void)0
#endif

/* Segments that a lone lane traces before it looks after its paths' ends. On GPUs the lanes of a warp end one by one, and
   all wait while one starts anew: better that the ended ones wait for each other. 1: 3.02, 6: 3.47 Gsamples/s (H200). */
#ifndef PT_BATCH
#define PT_BATCH 1
#endif

PT_OUTLINE void trace_units(__global PtTally* tallies, __global uint* queue, PT_SPHERE_SPACE const PtSphere* spheres,
                            PT_SURFACE_SPACE const PtSurface* surface_rows, __global const uint* camera_sides,
                            __global const uint* run_starts, PtLaunch launch COUNTED_PARAMETER) {
    PT_STAY_OUTLINED;
#ifdef PT_FEW
    const uint opaque = PT_OPAQUE, count = PT_FEW;
#else
    const uint opaque = launch.opaque_spheres, count = opaque + launch.two_sided_spheres;
#endif
    Scene scene = {spheres, opaque, count, 0u};
    const Surfaces surfaces = surfaces_of(surface_rows, background(scene));
    const Start start = {(PT_SURFACE_SPACE const PtStart*)&surface_rows[background(scene) + 1u], camera_sides};
    scene.distance_mask = start.row->distance_mask;
    Unit unit = no_unit();
    Path path = no_path();
    Spare spare = no_spare();
    lanes_mask alive = take_units(&unit, lanes_all(), 0u, queue, run_starts, &launch);
    COUNTED_LANES(lanes_all(), PT_TAKE_WORK)
    refill(&spare, &unit, &launch);
    start_spares(&path, &spare, alive, 0u, start, &launch);

    uint turn = 0u;
    while (lanes_any(alive)) {
        lanes_u face;
        lanes_mask ends;
        const uint stop = uint_hold(min(turn + PT_BATCH, LANE(path.last_turn, 0)));
        do {
            const Hit hit = nearest_hit(scene, &path.ray, &path.inside);
            const Vec draw = draw_bounce(&path.random);
            face = hit_face(&hit);
            const Surface surface = surface_of(&surfaces, face);
            gather_radiance(&path, &surfaces, face);
            path.throughput = vec_mul(path.throughput, surface.weight);
            COUNTED_SEGMENTS(counted_lanes(alive))
            COUNTED(1u, PT_STEP_WORK(scene.count))
            COUNTED_LANES(alive, PT_SEGMENT_WORK(scene))
            COUNTED(two_sided_spheres(scene) > 0u ? counted_lanes(alive) : 0u, PT_REFRACTION_WORK)
            scatter(scene, &path.ray, &path.inside, &hit, &surface, &draw);
            turn = uint_hold(turn + 1u);
            ends = surface.mirrored < 0.0f;
        } while (PT_BATCH > 1 && turn < stop && !lanes_any(ends));
        const lanes_mask full = lanes_hold(turn >= path.last_turn);
        const lanes_mask ended = lanes_meet(lanes_hold(full | ends));
        COUNTED_LANES(alive & ended, PT_PATH_WORK)

        if (lanes_any(ended)) {
            Vec radiance = gathered_radiance(&path, &surfaces, face);
            if (PTB_LANES == 1 || lanes_any(full | (ended & !spare.ready))) {
                const lanes_mask lacking = MASK_OF_MANY(alive & ended & !spare.ready);
                if (PTB_LANES > 1) add_samples(&unit, spare.radiance, !spare.ready);
                add_samples(&unit, radiance, lacking);
                radiance = vec_select(radiance, vec_of((float4)(0.0f)), lacking);
                spare.radiance = vec_of((float4)(0.0f));
                unit.counts += lanes_select_u((lanes_u)(0u), (lanes_u)(PT_FULL_LENGTH), full);
                const lanes_mask finished = lacking & (unit.sample == unit.end);
                if (lanes_any(finished)) {
                    write_units(&unit, finished, turn, tallies);
                    COUNTED_LANES(alive & finished, PT_UNIT_WORK)
                    COUNTED_LANES(alive & finished, PT_TAKE_WORK)
                    if (PTB_LANES == 1) turn = 0u; /* so its unit's first turn needs no register */
                    alive &= !finished | take_units(&unit, finished, turn, queue, run_starts, &launch);
                }
                refill(&spare, &unit, &launch);
            }
            spare.radiance = vec_select(spare.radiance, radiance, ended);
            start_spares(&path, &spare, ended, turn, start, &launch);
        }
    }
}

/* Where the scene is read from a copy: one a work-group, or one a work-item. */
#if PT_SPHERES == PT_IN_LOCAL || PT_SURFACES == PT_IN_LOCAL
#define PT_COPY_FIRST (uint)get_local_id(0)
#define PT_COPY_STEP (uint)get_local_size(0)
#else
#define PT_COPY_FIRST 0u
#define PT_COPY_STEP 1u
#endif

__kernel void pt_render(__global PtTally* tallies, __global uint* queues, PT_SPHERE_BUFFER const PtSphere* spheres,
                        PT_SURFACE_BUFFER const PtSurface* surfaces, __global const uint* camera_sides,
                        __global const uint* run_starts, const PtFewSpheres few,
                        const PtLaunch launch COUNTED_ROWS) {
    COUNTED_BEGIN
    (void)spheres, (void)few;
#if PT_SPHERES == PT_IN_ARGUMENT
    PT_SPHERE_SPACE const PtSphere* all = few.sphere;
#elif PT_SPHERES == PT_IN_LOCAL || PT_SPHERES == PT_IN_PRIVATE
    PT_SPHERE_SPACE PtSphere all[PT_COUNT];
    for (uint i = PT_COPY_FIRST; i < PT_COUNT; i += PT_COPY_STEP) all[i] = spheres[i];
#else
    PT_SPHERE_SPACE const PtSphere* all = spheres;
#endif
#if PT_SURFACES == PT_IN_LOCAL || PT_SURFACES == PT_IN_PRIVATE
    PT_SURFACE_SPACE PtSurface rows[PT_FACES + 2];
    for (uint i = PT_COPY_FIRST; i < PT_FACES + 2; i += PT_COPY_STEP) rows[i] = surfaces[i];
#else
    PT_SURFACE_SPACE const PtSurface* rows = surfaces;
#endif
#if PT_SPHERES == PT_IN_LOCAL || PT_SURFACES == PT_IN_LOCAL
    barrier(CLK_LOCAL_MEM_FENCE);
#endif
    trace_units(tallies, queues + launch.slice, all, rows, camera_sides, run_starts, launch COUNTED_ARGUMENT);
    COUNTED_END
}

/* A pixel's sums so far, and the tallies of one launch in the order of the units. */
static inline PtTally add_tallies(PtTally sum, __global const PtTally* tallies, uint pixel,
                                  const PtLaunch* launch COUNTED_PARAMETER) {
    for (uint unit = pixel; unit < launch->units; unit += launch->pixels) {
        const PtTally tally = tallies[unit];
        sum.radiance += tally.radiance;
        sum.squares += tally.squares;
        sum.samples += tally.samples;
        sum.segments += tally.segments;
        sum.full_length_paths += tally.full_length_paths;
        COUNTED(1u, PT_ADD_WORK)
    }
    return sum;
}

/* Adds the tallies of one launch to the film, a pixel a work-item. */
__kernel void pt_add(__global PtTally* film, __global const PtTally* tallies, const PtLaunch launch COUNTED_ROWS) {
    const uint pixel = (uint)get_global_id(0);
    if (pixel >= launch.pixels) return;
    COUNTED_BEGIN
    film[launch.first_pixel + pixel] =
        add_tallies(film[launch.first_pixel + pixel], tallies, pixel, &launch COUNTED_ARGUMENT);
    COUNTED(1u, PT_PIXEL_WORK)
    COUNTED_END
}

#ifdef PT_IMAGE_FILM

/* The same for a film in an image, of which the launch may have traced a part: the sums go to another image. */
__kernel void pt_add_to_image(__read_only image2d_t film, __write_only image2d_t sums, __global const PtTally* tallies,
                              const PtLaunch launch COUNTED_ROWS) {
    const sampler_t nearest = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_NONE | CLK_FILTER_NEAREST;
    const int width = get_image_width(film), rows = get_image_height(film) / PT_FILM_LAYERS;
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * rows) return;
    COUNTED_BEGIN
    const int2 at = (int2)(pixel % width, pixel / width), below = (int2)(0, rows);
    const uint4 counts = read_imageui(film, nearest, at + 2 * below);
    PtTally sum;
    sum.radiance = as_float4(read_imageui(film, nearest, at));
    sum.squares = as_float4(read_imageui(film, nearest, at + below));
    sum.samples = counts.x;
    sum.segments = counts.y;
    sum.full_length_paths = counts.z;
    const uint number = (uint)pixel - launch.first_pixel; /* huge for a pixel before the launch's */
    if (number < launch.pixels) sum = add_tallies(sum, tallies, number, &launch COUNTED_ARGUMENT);
    write_imageui(sums, at, as_uint4(sum.radiance));
    write_imageui(sums, at + below, as_uint4(sum.squares));
    write_imageui(sums, at + 2 * below, (uint4)(sum.samples, sum.segments, sum.full_length_paths, 0u));
    COUNTED(1u, PT_PIXEL_WORK)
    COUNTED_END
}

#endif
