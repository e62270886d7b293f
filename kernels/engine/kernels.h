/* The kernels of an integrator, whose file includes this last, after the loop that keeps its lanes busy. It has defined
   INTEGRATOR, its name, and for engine/trace.h

       lanes_mask trace_segment(const World*, Path*, const Hit*, lanes_mask alive, uint turn COUNTED_PARAMETER)
           traces the next segment of every path, which ends at this hit; returns the lanes whose path does so, too
       Vec gathered_radiance(const World*, const Path*, lanes_u face)
           what a path is worth that ended there

   and with ENGINE_SPLATS, for engine/lights.h,

       void leave_lamps(const World*, Path*, lanes_mask fresh COUNTED_PARAMETER)
           puts these paths, which start where the camera is, on lamps
       lanes_mask trace_light_segment(const World*, const Picture*, Path*, lanes_mask fresh, lanes_mask alive,
                                      const Sides* of_camera, Traced* COUNTED_PARAMETER)
           traces the next segment of every path, fresh ones' first; returns the lanes whose path may go on

   or for engine/sample.h, with ENGINE_SPLATS,

       lanes_mask trace_sample(const World*, const Picture*, Path*, lanes_mask alive, Traced* COUNTED_PARAMETER)
           traces what belongs to the samples of these camera paths, which gather their radiance; returns the lanes whose
           camera path reached its full length */
#ifndef PTB_ENGINE_KERNELS_H
#define PTB_ENGINE_KERNELS_H

#include "engine/film.h"

#define KERNEL(verb) SCENE_PASTE(INTEGRATOR, _##verb)

/* Where the scene is read from a copy: one a work-group, or one a work-item. */
#if SCENE_SPHERES == SCENE_IN_LOCAL || SCENE_SURFACES == SCENE_IN_LOCAL
#define ENGINE_COPY_FIRST (uint)get_local_id(0)
#define ENGINE_COPY_STEP (uint)get_local_size(0)
#else
#define ENGINE_COPY_FIRST 0u
#define ENGINE_COPY_STEP 1u
#endif

/* Traces the launch's units; see engine/trace.h and engine/sample.h. */
__kernel void KERNEL(render)(__global Tally* tallies, __global uint* queues, SCENE_SPHERE_BUFFER const SceneSphere* spheres,
                             SCENE_SURFACE_BUFFER const SceneSurface* surfaces, __global const uint* camera_sides,
                             __global const uint* run_starts, __global const SceneLamp* lamps, const SceneFewSpheres few,
                             SCENE_TREE_PARAMETERS const EngineLaunch launch ENGINE_SPLATS_PARAMETER COUNTED_ROWS) {
    COUNTED_BEGIN
    (void)spheres, (void)few;
#if SCENE_SPHERES == SCENE_IN_ARGUMENT
    SCENE_SPHERE_SPACE const SceneSphere* all = few.sphere;
#elif SCENE_SPHERES == SCENE_IN_LOCAL || SCENE_SPHERES == SCENE_IN_PRIVATE
    SCENE_SPHERE_SPACE SceneSphere all[SCENE_COUNT];
    for (uint i = ENGINE_COPY_FIRST; i < SCENE_COUNT; i += ENGINE_COPY_STEP) all[i] = spheres[i];
#else
    SCENE_SPHERE_SPACE const SceneSphere* all = spheres;
#endif
#if SCENE_SURFACES == SCENE_IN_LOCAL || SCENE_SURFACES == SCENE_IN_PRIVATE
    SCENE_SURFACE_SPACE SceneSurface rows[SCENE_FACES + 2];
    for (uint i = ENGINE_COPY_FIRST; i < SCENE_FACES + 2; i += ENGINE_COPY_STEP) rows[i] = surfaces[i];
#else
    SCENE_SURFACE_SPACE const SceneSurface* rows = surfaces;
#endif
#if SCENE_SPHERES == SCENE_IN_LOCAL || SCENE_SURFACES == SCENE_IN_LOCAL
    barrier(CLK_LOCAL_MEM_FENCE);
#endif
    trace_units(tallies, queues, all, rows, camera_sides, run_starts, lamps,
                SCENE_TREE_ARGUMENTS launch ENGINE_SPLATS_ARGUMENT COUNTED_ARGUMENT);
    COUNTED_END
}

/* Adds the tallies of one launch to the film, a pixel a work-item. */
__kernel void KERNEL(add)(__global FilmPixel* film, __global const Tally* tallies, const EngineLaunch launch COUNTED_ROWS) {
    const uint pixel = (uint)get_global_id(0);
    if (pixel >= launch.pixels) return;
    COUNTED_BEGIN
    __global FilmPixel* place = film + launch.first_pixel + pixel;
    FilmPixel sum = film_load(place);
    add_tallies(&sum, tallies, pixel, &launch COUNTED_ARGUMENT);
    film_store(place, &sum);
    COUNTED(1u, ENGINE_PIXEL_WORK)
    COUNTED_END
}

#ifdef ENGINE_IMAGE_FILM

/* The same for a film in an image, of which the launch may have traced a part: the sums go to another image. */
__kernel void KERNEL(add_to_image)(__read_only image2d_t film, __write_only image2d_t sums, __global const Tally* tallies,
                                   const EngineLaunch launch COUNTED_ROWS) {
    const int width = get_image_width(film), rows = get_image_height(film) / FILM_LAYERS;
    const int pixel = (int)get_global_id(0);
    if (pixel >= width * rows) return;
    COUNTED_BEGIN
    const int2 at = (int2)(pixel % width, pixel / width);
    FilmPixel sum = film_load_texels(film, at, rows);
    const uint number = (uint)pixel - launch.first_pixel; /* huge for a pixel before the launch's */
    if (number < launch.pixels) add_tallies(&sum, tallies, number, &launch COUNTED_ARGUMENT);
    film_store_texels(sums, at, rows, &sum);
    COUNTED(1u, ENGINE_PIXEL_WORK)
    COUNTED_END
}

#endif
#endif
