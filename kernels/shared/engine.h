/* The contract between the host and the kernel `pt`. */
#ifndef PTB_SHARED_ENGINE_H
#define PTB_SHARED_ENGINE_H

#include "shared/camera.h"

/* A sphere as the intersection wants it. */
typedef struct SceneSphere {
    ptb_float4 centre_k; /* xyz: centre; w: |centre|^2 - radius^2, rounded once from double */
} SceneSphere;
PTB_ASSERT_SIZE(SceneSphere, 16);

/* What a lone two-sided sphere among few has in its word of sides inside: see scene/scene.h. */
#define SCENE_LONE_SIDE 0x80000001u

/* Times this, a unit's paths of full length are counted in the word that has the number of its samples. */
#define ENGINE_FULL_LENGTH 0x10000u

/* Spheres of so few faces are passed by value and known one by one while compiling; one row more is the background. */
#define SCENE_FEW_MOST 15

/* The bits of a distance that are kept where a face's number is put into the others. */
#define SCENE_DISTANCE_MASK 0xfffffff0u

typedef struct SceneFewSpheres {
    SceneSphere sphere[SCENE_FEW_MOST + 1];
} SceneFewSpheres;
PTB_ASSERT_SIZE(SceneFewSpheres, 256);

/* What scattering needs to know of a face of a sphere. Rows: the outer and the inner face of each two-sided sphere, the
   one face of each opaque one, the background. `outwards` is 1 / radius, negative on an inner face: times the way from
   the centre, the normal on this side. `eta` is the index of refraction here over that beyond. */
typedef struct SceneSurface {
    ptb_float4 centre_matte; /* xyz: centre; w: outwards if matte, else 0 */
    ptb_float4 weight_eta;   /* rgb: throughput factor of a bounce; w: eta^2, NaN unless dielectric, so that nothing
                                goes through */
    ptb_float4 radiance;     /* rgb: emitted; w: unused */
    ptb_float4 traits;       /* x: 2 / radius^2 of a mirror or dielectric, 0 if matte, -1 if no path goes on from it;
                                y: outwards eta; z: outwards / eta; w: 1 - eta^2 */
    ptb_float4 padding; /* rows of 80 bytes lie in different banks of a GPU's local memory, rows of 64 in two of them */
} SceneSurface;
PTB_ASSERT_SIZE(SceneSurface, 80);

/* What all paths start with; one more row of the surfaces. */
typedef struct SceneStart {
    ptb_float4 position_side; /* xyz: of the camera; w: bits of the first word of the sides that it is on */
    float gap[SCENE_FEW_MOST]; /* of few spheres: radius^2 - |camera - centre|^2, rounded once from double */
    ptb_uint distance_mask; /* SCENE_DISTANCE_MASK */
} SceneStart;
PTB_ASSERT_SIZE(SceneStart, 80);

/* Where spheres and surfaces lie that rays read: SCENE_SPHERES and SCENE_SURFACES. */
#define SCENE_IN_ARGUMENT 0
#define SCENE_IN_CONSTANT 1
#define SCENE_IN_GLOBAL 2
#define SCENE_IN_LOCAL 3
#define SCENE_IN_PRIVATE 4

/* Where in its pixel a sample lies: ENGINE_FILTER. */
#define ENGINE_JITTER 0
#define ENGINE_CENTRE 1
#define ENGINE_STRATIFIED 2

/* Work of one launch. A unit is a run of consecutive samples of one pixel. Unit number u of the launch is pixel
   `first_pixel + u % pixels`, and the run number `first_run + u / pixels` of the table of the runs' first samples. */
typedef struct EngineLaunch {
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
    ptb_uint units_per_lane; /* at most, with ENGINE_BOUNDED: some drivers bound the turns of a loop */
    ptb_uint first_unit;    /* this launch takes the units from here to `units`, */
    ptb_uint slice;         /* by the counter of this number */
    ptb_uint strata_columns; /* of stratified pixels; */
    float stratum_width;     /* in pixels */
    float stratum_height;
    ptb_uint padding[3];
} EngineLaunch;
PTB_ASSERT_SIZE(EngineLaunch, 144);

/* What a unit leaves, or a pixel of the film holds: sums over its samples. */
typedef struct Tally {
    ptb_float4 radiance; /* rgb: sum; w: unused */
    ptb_float4 squares;  /* rgb: sum of squares; w: unused */
    ptb_uint samples;
    ptb_uint segments;
    ptb_uint full_length_paths; /* paths that traced path_length segments */
    ptb_uint padding;
} Tally;
PTB_ASSERT_SIZE(Tally, 48);

/* A film in an image has its tallies in so many layers, one below the other: radiance, squares, and counts. */
#define ENGINE_FILM_LAYERS 3

#endif
