/* The contract between the host and the kernel `pt`. */
#ifndef PTB_SHARED_PT_H
#define PTB_SHARED_PT_H

#include "shared/camera.h"

/* A sphere as the intersection wants it. */
typedef struct PtSphere {
    ptb_float4 centre_k; /* xyz: centre; w: |centre|^2 - radius^2, or radius^2 of a distant one: see pt/hit.h; all
                            rounded once from double, from an origin of the device's own */
} PtSphere;
PTB_ASSERT_SIZE(PtSphere, 16);

/* What a lone two-sided sphere among few has in its word of sides inside: see pt/scene.h. */
#define PT_LONE_SIDE 0x80000001u

/* Times this, a unit's paths of full length are counted in the word that has the number of its samples. */
#define PT_FULL_LENGTH 0x10000u

/* Spheres of so few faces are passed by value and known one by one while compiling; one row more is the background. */
#define PT_FEW_MOST 15

/* The bits of a distance that are kept where a face's number is put into the others. */
#define PT_DISTANCE_MASK 0xfffffff0u

typedef struct PtFewSpheres {
    PtSphere sphere[PT_FEW_MOST + 1];
} PtFewSpheres;
PTB_ASSERT_SIZE(PtFewSpheres, 256);

/* What scattering needs to know of a face of a sphere. Rows: the outer and the inner face of each two-sided sphere, the
   one face of each opaque one, the background. `outwards` is 1 / radius, negative on an inner face: times the way from
   the centre, the normal on this side. `eta` is the index of refraction here over that beyond. */
typedef struct PtSurface {
    ptb_float4 centre_matte; /* xyz: centre; w: outwards if matte, else 0 */
    ptb_float4 weight_eta;   /* rgb: throughput factor of a bounce; w: eta^2, NaN unless dielectric, so that nothing
                                goes through */
    ptb_float4 radiance;     /* rgb: emitted; w: unused */
    ptb_float4 traits;       /* x: 2 / radius^2 of a mirror or dielectric, 0 if matte, -1 if no path goes on from it;
                                y: outwards eta; z: outwards / eta; w: 1 - eta^2 */
    ptb_float4 padding; /* rows of 80 bytes lie in different banks of a GPU's local memory, rows of 64 in two of them */
} PtSurface;
PTB_ASSERT_SIZE(PtSurface, 80);

/* What all paths start with; one more row of the surfaces. */
typedef struct PtStart {
    ptb_float4 position_side; /* xyz: of the camera; w: bits of the first word of the sides that it is on */
    float gap[PT_FEW_MOST]; /* of few spheres: radius^2 - |camera - centre|^2, rounded once from double */
    ptb_uint distance_mask; /* PT_DISTANCE_MASK */
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
    float inverse_width;
    ptb_uint first_pixel;
    ptb_uint pixels;
    float inverse_pixels;
    ptb_uint first_run;
    ptb_uint units;
    ptb_uint path_length;
    ptb_uint seed;
    ptb_uint opaque_spheres;  /* the first ones: no path is ever inside */
    ptb_uint two_sided_spheres; /* the rest: dielectrics, and what the camera is in */
    ptb_uint units_per_lane; /* at most, with PT_BOUNDED: some drivers bound the turns of a loop */
    ptb_uint first_unit;    /* this launch takes the units from here to `units`, */
    ptb_uint slice;         /* by the counter of this number */
    ptb_uint strata_columns; /* of stratified pixels; */
    float stratum_width;     /* in pixels */
    float stratum_height;
    ptb_uint padding[3];
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
