/* The contract between the host and the kernel `thesis`. */
#ifndef PTB_SHARED_THESIS_H
#define PTB_SHARED_THESIS_H

#include "shared/camera.h"

#define THESIS_MATTE 0
#define THESIS_MIRROR 1
#define THESIS_DIELECTRIC 2
#define THESIS_EMITTER 3

typedef struct ThesisMaterial {
    ptb_float4 colour;   /* rgb: albedo or reflectance */
    ptb_float4 radiance; /* rgb: emitted */
    ptb_int type;        /* THESIS_... */
    float ior;
    ptb_int scatters; /* 0: the path ends here */
    ptb_int padding;
} ThesisMaterial;
PTB_ASSERT_SIZE(ThesisMaterial, 48);

/* A sphere with its whole material inside, as the thesis keeps it. */
typedef struct ThesisSphere {
    ptb_float4 centre_radius; /* xyz: centre; w: radius */
    ThesisMaterial material;
} ThesisSphere;
PTB_ASSERT_SIZE(ThesisSphere, 64);

/* Work of one launch: `samples` further samples of the pixels from `first_pixel` on. In a two-dimensional range
   the first dimension is the image's width. */
typedef struct ThesisLaunch {
    PtbCamera camera;
    ptb_uint width;
    ptb_uint first_pixel;
    ptb_uint pixels;
    ptb_uint samples;
    ptb_uint spp; /* of the whole image: each sample weighs 1 / spp */
    ptb_uint path_length;
    ptb_uint sphere_count;
    ptb_uint padding;
} ThesisLaunch;
PTB_ASSERT_SIZE(ThesisLaunch, 96);

#endif
