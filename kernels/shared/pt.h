/* The contract between the host and the kernel `pt`. */
#ifndef PTB_SHARED_PT_H
#define PTB_SHARED_PT_H

#include "shared/camera.h"

/* A sphere as the intersection wants it. */
typedef struct PtSphere {
    ptb_float4 centre_k; /* xyz: centre; w: |centre|^2 - radius^2, rounded once from double */
} PtSphere;
PTB_ASSERT_SIZE(PtSphere, 16);

/* Spheres of so few faces are passed by value and known one by one while compiling; one row more is the background. */
#define PT_FEW_MOST 15

typedef struct PtFewSpheres {
    PtSphere sphere[PT_FEW_MOST + 1];
} PtFewSpheres;
PTB_ASSERT_SIZE(PtFewSpheres, 256);

/* What scattering needs to know of a face of a sphere. Rows: the outer and the inner face of each two-sided sphere, the
   one face of each opaque one, the background. `outwards` is 1 / radius, negative on an inner face: times the way from
   the centre, the normal on this side. A side is the bit of its two-sided sphere, when one word holds all bits; else its
   number. Bits count from the top, since signs are tested for nothing. */
typedef struct PtSurface {
    ptb_float4 centre_matte; /* xyz: centre; w: outwards if matte, else 0 */
    ptb_float4 weight_eta;   /* rgb: throughput factor of a bounce; w: the index of refraction here over that beyond, NaN
                                unless dielectric, so that nothing goes through */
    ptb_float4 radiance;     /* rgb: emitted; w: unused */
    ptb_float4 traits;       /* x: 2 / radius^2 of a mirror or dielectric, 0 if matte, -1 if no path goes on from it;
                                y: outwards; z: outwards / eta; w: bits of its side */
    ptb_float4 padding; /* rows of 80 bytes lie in different banks of a GPU's local memory, rows of 64 in two of them */
} PtSurface;
PTB_ASSERT_SIZE(PtSurface, 80);

/* What all paths start with; one more row of the surfaces. */
typedef struct PtStart {
    ptb_float4 position_side; /* xyz: of the camera; w: bits of the first word of the sides that it is on */
    float gap[PT_FEW_MOST + 1]; /* of few spheres: radius^2 - |camera - centre|^2, rounded once from double */
} PtStart;
PTB_ASSERT_SIZE(PtStart, 80);

/* Where spheres and surfaces lie that rays read: PT_SPHERES and PT_SURFACES. */
#define PT_IN_ARGUMENT 0
#define PT_IN_CONSTANT 1
#define PT_IN_GLOBAL 2
#define PT_IN_LOCAL 3
#define PT_IN_PRIVATE 4

/* Where in its pixel a sample lies: PT_FILTER. */
#define PT_JITTER 0
#define PT_CENTRE 1
#define PT_STRATIFIED 2

/* Work of one launch. A unit is a run of consecutive samples of one pixel. Unit number u of the launch is pixel
   `first_pixel + u % pixels`, and the run number `first_run + u / pixels` of the table of the runs' first samples. */
typedef struct PtLaunch {
    PtbCamera camera;
    ptb_uint width;
    ptb_uint first_pixel;
    ptb_uint pixels;
    ptb_uint first_run;
    ptb_uint units;
    ptb_uint path_length;
    ptb_uint seed;
    ptb_uint opaque_spheres;  /* the first ones: no path is ever inside */
    ptb_uint two_sided_spheres; /* the rest: dielectrics, and what the camera is in */
    ptb_uint units_per_lane; /* at most: some drivers bound the turns of a loop */
    ptb_uint distance_mask; /* ~15; a constant, but not told to the compiler: see pt/hit.h */
    ptb_uint first_unit;    /* this launch takes the units from here to `units`, */
    ptb_uint slice;         /* by the counter of this number */
    ptb_uint strata_columns; /* of stratified pixels; */
    float stratum_width;     /* in pixels */
    float stratum_height;
} PtLaunch;
PTB_ASSERT_SIZE(PtLaunch, 128);

/* What a unit leaves, or a pixel of the film holds: sums over its samples. */
typedef struct PtTally {
    ptb_float4 radiance; /* rgb: sum; w: unused */
    ptb_float4 squares;  /* rgb: sum of squares; w: unused */
    ptb_uint samples;
    ptb_uint segments;
    ptb_uint full_length_paths; /* paths that traced path_length segments */
    ptb_uint padding;
} PtTally;
PTB_ASSERT_SIZE(PtTally, 48);

/* A film in an image has its tallies in so many layers, one below the other: radiance, squares, and counts. */
#define PT_FILM_LAYERS 3

#endif
