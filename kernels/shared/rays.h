/* Rays to be met with a tree of triangles, one by one, and what they meet: kernels/probe/rays.cl. */
#ifndef PTB_SHARED_RAYS_H
#define PTB_SHARED_RAYS_H

#include "shared/tree.h"

typedef struct ProbeRay {
    ptb_float4 origin_left;     /* w: bits of the number of the triangle that it starts at, or TREE_NOTHING */
    ptb_float4 direction_reach; /* xyz: of length 1; w: what is farther is not met */
} ProbeRay;
PTB_ASSERT_SIZE(ProbeRay, 32);

typedef struct ProbeHit {
    float distance;
    ptb_uint triangle; /* its number, or TREE_NOTHING */
    float b, c;        /* shares of its second and third corner in the point met */
} ProbeHit;
PTB_ASSERT_SIZE(ProbeHit, 16);

#endif
