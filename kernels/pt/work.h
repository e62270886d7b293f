/* The arithmetic of each step of `pt`, for the build that counts: additions and multiplications, roots, divisions of
   one lane. Held against the instructions that Oclgrind sees by tests/render/counted.py. */
#ifndef PTB_PT_WORK_H
#define PTB_PT_WORK_H

#include "lib/counted.h"
#include "pt/scene.h"

/* vec_normalize: a scalar product, three products, and lib/roots.h's 1 / sqrt. */
#if PTB_PTX
#define PT_RSQRT_FLOPS 0u
#define PT_RSQRT_ROOTS 1u
#define PT_RSQRT_DIVISIONS 0u
#elif RSQRT_ESTIMATED
#define PT_RSQRT_FLOPS 5u /* an estimate, and a Newton step */
#define PT_RSQRT_ROOTS 0u
#define PT_RSQRT_DIVISIONS 0u
#else
#define PT_RSQRT_FLOPS 0u
#define PT_RSQRT_ROOTS 1u
#define PT_RSQRT_DIVISIONS 1u
#endif
#define PT_NORMALIZE_FLOPS (8u + PT_RSQRT_FLOPS)

/* lib/sphere_direction.h: z and the circle's radius there, sine and cosine. */
#if PTB_PTX
#define PT_SPHERE_FLOPS (3u + 3u)
#define PT_SPHERE_ROOTS (1u + 2u)
#else
#define PT_SPHERE_FLOPS (3u + 22u)
#define PT_SPHERE_ROOTS 1u
#endif

/* pt/hit.h: what a ray prepares; what a sphere costs, the move to the hit included where it carries gaps; what the zeros
   of centres save; what distant and vast spheres cost more. */
#define PT_ZEROS (popcount(PT_ZERO_X) + popcount(PT_ZERO_Y) + popcount(PT_ZERO_Z))
#ifdef PT_CARRIED
#define PT_LINE_FLOPS 5u
#define PT_TEST_FLOPS (6u + 2u + 1u + 4u)
#define PT_SAVED_FLOPS (2u * PT_ZEROS)
#else
#define PT_LINE_FLOPS 13u
#define PT_TEST_FLOPS (6u + 9u + 1u)
#define PT_SAVED_FLOPS (4u * PT_ZEROS)
#endif
#ifdef PT_CAREFUL_BEGIN
#define PT_DISTANT_ONES (PT_DISTANT_END - PT_DISTANT_BEGIN)
#define PT_VAST_ONES (PT_CAREFUL_END - PT_CAREFUL_BEGIN - PT_DISTANT_ONES)
#else
#define PT_DISTANT_ONES 0u
#define PT_VAST_ONES 0u
#endif
#define PT_CARE_FLOPS (5u * PT_DISTANT_ONES + 2u * PT_VAST_ONES)

#ifdef PT_GLOWS
#define PT_GATHER_FLOPS 6u /* a segment */
#define PT_END_FLOPS 0u    /* a path */
#else
#define PT_GATHER_FLOPS 0u
#define PT_END_FLOPS 3u
#endif

/* pt/scatter.h but for refraction: the move, from the centre, along, the normal's share and the sum. */
#define PT_SCATTER_FLOPS (6u + 3u + 5u + 2u + 6u)

/* Where in its pixel a sample lies, and in the image. */
#if defined(PT_FILTER) && PT_FILTER == PT_CENTRE
#define PT_PLACE_FLOPS 2u
#elif defined(PT_FILTER) && PT_FILTER == PT_STRATIFIED
#define PT_PLACE_FLOPS 11u
#else
#define PT_PLACE_FLOPS 2u
#endif

/* Bytes that rays read of global memory. Copies of the scene, made once a work-group or work-item, are not counted. */
#define PT_SPHERE_BYTES (PT_SPHERES == PT_IN_GLOBAL ? (uint)sizeof(PtSphere) : 0u)
#define PT_SURFACE_BYTES(read) (PT_SURFACES == PT_IN_GLOBAL ? (read) : 0u)

/* Spheres whose root is an estimate and a Newton step, of 6 flops. */
#define PT_ESTIMATES(scene) (SQRT_ESTIMATED * ((scene).opaque / 2u))

/* A segment, throughput too, and the numbers of its surface. */
#define PT_SEGMENT_WORK(scene)                                                                                     \
    (PT_LINE_FLOPS + (scene).count * PT_TEST_FLOPS + PT_ESTIMATES(scene) * 6u + PT_CARE_FLOPS - PT_SAVED_FLOPS +   \
     PT_GATHER_FLOPS + 3u + PT_SCATTER_FLOPS + PT_SPHERE_FLOPS + PT_NORMALIZE_FLOPS),                              \
        ((scene).count - PT_ESTIMATES(scene) + PT_SPHERE_ROOTS + PT_RSQRT_ROOTS),                                  \
        (PT_RSQRT_DIVISIONS + PT_VAST_ONES), PT_SURFACE_BYTES(48u)
/* The spheres, which all lanes of a work-item share. */
#define PT_STEP_WORK(spheres) 0u, 0u, 0u, (spheres) * PT_SPHERE_BYTES
/* Refraction, which every ray works out in scenes with two-sided spheres. */
#if defined(PT_FEW) && TABLE_PERMUTES
#define PT_REFRACTION_WORK 14u, 1u, 0u, 0u
#else
#define PT_REFRACTION_WORK 13u, 1u, 0u, 0u
#endif
/* A path: its radiance and square added, and the next one's camera ray. */
#define PT_PATH_WORK \
    (PT_END_FLOPS + 9u + PT_PLACE_FLOPS + 12u + PT_NORMALIZE_FLOPS), PT_RSQRT_ROOTS, PT_RSQRT_DIVISIONS, \
        PT_SURFACE_BYTES(12u)
/* A look for a unit, of use or not: its place, and its run. */
#define PT_TAKE_WORK 4u, 0u, 0u, 2u * (uint)sizeof(uint)
/* A unit: its tally. */
#define PT_UNIT_WORK 0u, 0u, 0u, (uint)sizeof(PtTally)
/* A tally added to a pixel, of colours of so many numbers (1 counts vectors' instructions), and a pixel of the film. */
#ifndef PT_WIDTH
#define PT_WIDTH 3u
#endif
#define PT_ADD_WORK (2u * PT_WIDTH), 0u, 0u, (uint)sizeof(PtTally)
#define PT_PIXEL_WORK 0u, 0u, 0u, 2u * (uint)sizeof(PtTally)

#endif
