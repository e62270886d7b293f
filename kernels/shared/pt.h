/* The contract between the host and the kernel `pt`. */
#ifndef PTB_SHARED_PT_H
#define PTB_SHARED_PT_H

#include "shared/camera.h"

/* A sphere as the intersection wants it. */
typedef struct PtSphere {
    ptb_float4 centre_k; /* xyz: centre; w: |centre|^2 - radius^2, rounded once from double */
} PtSphere;
PTB_ASSERT_SIZE(PtSphere, 16);

/* So few spheres are passed by value and known one by one while compiling; one row more is the background. */
#define PT_FEW_MOST 15

typedef struct PtFewSpheres {
    PtSphere sphere[PT_FEW_MOST + 1];
    float camera_gap[PT_FEW_MOST + 1]; /* radius^2 - |camera - centre|^2, rounded once from double */
} PtFewSpheres;
PTB_ASSERT_SIZE(PtFewSpheres, 320);

/* What scattering needs to know of a sphere, one row a sphere, in the order of the spheres, and a last row for the
   background. */
typedef struct PtSurface {
    ptb_float4 centre_inverse_radius; /* xyz: centre; w: 1 / radius */
    ptb_float4 weight;                /* rgb: throughput factor of a bounce; w: index of refraction inside */
    ptb_float4 radiance;              /* rgb: emitted, from both faces; w: unused */
    ptb_float4 traits;  /* x: its kind, 0 matte, 1 mirror or dielectric, -1 if no path goes on from it; y: 1 / index of
                           refraction; z: unused; w: bits of its side */
    ptb_float4 padding; /* rows of 80 bytes lie in different banks of a GPU's local memory, rows of 64 in two of them */
} PtSurface;
PTB_ASSERT_SIZE(PtSurface, 80);

/* A surface's side is the bit of its two-sided sphere, 0 if opaque, when one word holds all bits; else its number, and
   PT_OPAQUE_SIDE if opaque. Bits count from the top, since signs are tested for nothing. The index of refraction is NaN unless dielectric, so that nothing goes through. */
#define PT_OPAQUE_SIDE 0xffffffffu

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

/* Work of one launch. A unit is a run of `samples_per_unit` consecutive samples of one pixel (the last unit of a
   pixel may be shorter). Unit number u of the launch is pixel `first_pixel + u % pixels`, and the run number
   `first_run + u / pixels`. */
typedef struct PtLaunch {
    PtbCamera camera;
    ptb_uint width;
    ptb_uint first_pixel;
    ptb_uint pixels;
    ptb_uint first_run;
    ptb_uint units;
    ptb_uint samples_per_unit;
    ptb_uint spp;
    ptb_uint path_length;
    ptb_uint seed;
    ptb_uint opaque_spheres;  /* the first ones: no path is ever inside */
    ptb_uint two_sided_spheres; /* the rest: dielectrics, and what the camera is in */
    ptb_uint units_per_lane; /* at most: some drivers bound the turns of a loop */
    ptb_uint camera_side;   /* first word of the sides that the camera is on */
    ptb_uint distance_mask; /* ~15; a constant, but not told to the compiler: see pt/hit.h */
    ptb_uint first_unit;    /* this launch takes the units from here to `units`, */
    ptb_uint slice;         /* by the counter of this number */
    ptb_uint strata_columns; /* of stratified pixels; */
    float stratum_width;     /* in pixels */
    float stratum_height;
    ptb_uint padding;
} PtLaunch;
PTB_ASSERT_SIZE(PtLaunch, 144);

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
