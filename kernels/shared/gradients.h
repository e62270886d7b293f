/* The contract between the host and the kernels that sum gradients and make a picture of them (kernels/engine/gradients.h, kernels/gbdpt/reconstruct.h). */
#ifndef PTB_SHARED_GRADIENTS_H
#define PTB_SHARED_GRADIENTS_H

#include "shared/types.h"

/* What one half of the samples makes of a pixel, where samples tell how it differs from its neighbours. */
typedef struct GradientPixel {
    ptb_long radiance[3]; /* times `radiance_scale`, like */
    ptb_long across[3];   /* how much more the right neighbour has, and */
    ptb_long down[3];     /* the one below */
    ptb_long squares[3];  /* of the mean over colours of what each sample added to these, times `squares_scale` */
} GradientPixel;
PTB_ASSERT_SIZE(GradientPixel, 96);

/* Work-items of a work-group: fixed, so that sums are made in one order; and pixels of each. */
#define RECONSTRUCT_GROUP 32
#define RECONSTRUCT_EACH 32

/* The weight of pixels beside that of gradients, where weights do not follow from variances. */
#define RECONSTRUCT_ALPHA 0.2f

/* What no variance is below, in units of the picture's mean variance. */
#define RECONSTRUCT_CERTAIN 3e-3f

/* Numbers of each problem, by place: what KERNEL(measure) sums, the squared residual before and after a turn, and the way's
   product with what becomes of it. */
#define RECONSTRUCT_MEASURED 0
#define RECONSTRUCT_RESIDUAL 1
#define RECONSTRUCT_APPLIED 3
#define RECONSTRUCT_SCALARS 4

typedef struct ReconstructLaunch {
    ptb_uint width;
    ptb_uint height;
    ptb_uint groups;     /* work-groups of a problem */
    ptb_uint problems;   /* 2: each half of the samples for itself; 1: all of them */
    ptb_uint samples[2]; /* of a pixel, in either half */
    float radiance_scale;
    float squares_scale;
} ReconstructLaunch;
PTB_ASSERT_SIZE(ReconstructLaunch, 32);

#endif
