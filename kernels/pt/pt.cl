/* `pt`: the physically right path tracer. Every work-item keeps PTB_LANES paths in registers; a lane whose path ended
   starts the next sample at once (path regeneration), and a lane whose unit of samples is done takes the next unit from
   one queue, so lanes stay busy whatever the work-group. A unit's sums depend on its number alone and are added to the
   film in the order of their numbers by a second kernel: no bit of the image depends on the launch. */
#include "pt/scatter.h"
#include "pt/unit.h"

__kernel void pt_render(__global PtTally* tallies, __global uint* queue, PT_SCENE_SPACE const PtSphere* spheres,
                        PT_SCENE_SPACE const PtSurface* surface_rows, __global const uint* camera_sides,
                        const PtLaunch launch) {
    Unit unit = no_unit();
    lanes_mask alive = take_units(&unit, lanes_all(), queue, &launch);
    if (!lanes_any(alive)) return;
    const Scene scene = {spheres, launch.opaque_spheres, launch.two_sided_spheres};
    const Surfaces surfaces = surfaces_of(surface_rows, launch.opaque_spheres + launch.two_sided_spheres);
    Path path = no_path();
    start_samples(&path, &unit, alive, camera_sides, &launch);

    while (lanes_any(alive)) {
        const Hit hit = nearest_hit(scene, path.ray, &path.inside);
        const lanes_mask met = hit.distance < INFINITY;
        const Surface surface = surface_of(&surfaces, hit.sphere);
        path.segments += 1u;
        path.throughput = vec_select(vec_of((float4)(0.0f)), path.throughput, met);
        path.radiance = vec_mul_add(path.radiance, path.throughput, surface.radiance);
        path.throughput = vec_mul(path.throughput, surface.weight);
        scatter(&path.ray, &path.inside, hit, &surface, &path.random);

        const lanes_mask full = path.segments >= launch.path_length;
        const lanes_mask ended = alive & (full | !met | (surface.ends > 0.0f));
        if (lanes_any(ended)) {
            add_samples(&unit, &path, ended, full);
            const lanes_mask finished = ended & (unit.samples_left == (lanes_u)(0u));
            if (lanes_any(finished)) {
                write_units(&unit, finished, tallies);
                alive &= !finished | take_units(&unit, finished, queue, &launch);
            }
            start_samples(&path, &unit, ended & alive, camera_sides, &launch);
        }
    }
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
