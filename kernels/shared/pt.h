/* The contract between the host and the kernel `pt`. */
#ifndef PTB_SHARED_PT_H
#define PTB_SHARED_PT_H

#include "shared/camera.h"

/* A sphere as the intersection wants it. */
typedef struct PtSphere {
    ptb_float4 centre_k; /* xyz: centre; w: |centre|^2 - radius^2, rounded once from double */
} PtSphere;
PTB_ASSERT_SIZE(PtSphere, 16);

/* What scattering needs to know of a sphere, one row a sphere, in the order of the spheres. The new direction is
   built as a d + b n + c s (see kernels/pt/scatter.h), so one row says what kind of material it is. */
typedef struct PtSurface {
    ptb_float4 centre_inverse_radius; /* xyz: centre; w: 1 / radius */
    ptb_float4 weight;                /* rgb: throughput factor of a bounce; w: 1 ends the path here, else 0 */
    ptb_float4 radiance;              /* rgb: emitted, from both faces; w: 1 matte, 0 mirror or dielectric */
    ptb_float4 optics; /* x: index of refraction inside, 0 unless dielectric; y: bit of its side; z, w: unused */
} PtSurface;
PTB_ASSERT_SIZE(PtSurface, 64);

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
} PtLaunch;
PTB_ASSERT_SIZE(PtLaunch, 112);

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

#endif
