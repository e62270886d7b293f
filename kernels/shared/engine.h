/* The contract between the host and the engine (kernels/engine), which integrators share. */
#ifndef PTB_SHARED_ENGINE_H
#define PTB_SHARED_ENGINE_H

#include "shared/scene.h"

/* Times this, a unit's paths of full length are counted in the word that has the number of its samples. */
#define ENGINE_FULL_LENGTH 0x10000u

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
    ptb_uint opaque_spheres;    /* the first ones: no path is ever inside */
    ptb_uint two_sided_spheres; /* the rest: dielectrics, and what the camera is in */
    ptb_uint units_per_lane;    /* at most, with ENGINE_BOUNDED: some drivers bound the turns of a loop */
    ptb_uint first_unit;        /* this launch takes the units from here to `units`, */
    ptb_uint slice;             /* by the counter of this number */
    ptb_uint strata_columns;    /* of stratified pixels; */
    float stratum_width;        /* in pixels */
    float stratum_height;
    float radiance_scale; /* the film's unit of radiance is 1 / this, a power of two; */
    float squares_scale;  /* of squared radiance, 1 / this */
    ptb_uint lamps;
    ptb_uint height;
    ptb_uint light_slice; /* the counter of paths from lamps, where they are traced by themselves */
    ptb_uint padding[2];
    PtbPicture picture;
    SceneLamp lamp; /* the first */
} EngineLaunch;
PTB_ASSERT_SIZE(EngineLaunch, 304);

/* What a unit leaves: sums over its samples. */
typedef struct Tally {
    ptb_float4 radiance; /* rgb: sum; w: unused */
    ptb_float4 squares;  /* rgb: sum of squares; w: unused */
    ptb_uint samples;
    ptb_uint segments;
    ptb_uint full_length_paths; /* paths that traced path_length segments */
    ptb_uint shadow_rays;
} Tally;
PTB_ASSERT_SIZE(Tally, 48);

/* A pixel of the film. Sums of whole numbers do not depend on the order of what is added: that of the tallies, of passes,
   or of devices that share an image. */
typedef struct FilmPixel {
    ptb_long radiance[3]; /* times `radiance_scale`; FILM_BROKEN once a tally had none that fits */
    ptb_long squares[3];  /* times `squares_scale` */
    ptb_uint samples;
    ptb_uint segments;
    ptb_uint full_length_paths;
    ptb_uint shadow_rays;
} FilmPixel;
PTB_ASSERT_SIZE(FilmPixel, 64);

#define FILM_BROKEN (-0x7fffffffffffffff - 1)

/* What samples of all pixels add to one: by atomics, whose sum of whole numbers does not depend on their order either. */
typedef struct Splat {
    ptb_long radiance[3];    /* times `radiance_scale` */
    ptb_uint light_segments; /* of the pixel's own samples: segments of their paths from lamps, */
    ptb_uint shadow_rays;    /* and shadow rays that no tally has */
    ptb_uint broken;         /* samples whose radiance was no number, or too large */
    ptb_uint padding;
} Splat;
PTB_ASSERT_SIZE(Splat, 40);

/* A film in an image has its pixels cut into so many layers of 16 bytes, one below the other. */
#define FILM_LAYERS 4

#endif
