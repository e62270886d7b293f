/* Rays of a list, to be met with a tree of triangles one by one, and what they meet: kernels/rays. */
#ifndef PTB_SHARED_RAYS_H
#define PTB_SHARED_RAYS_H

#include "shared/camera.h"
#include "shared/tree.h"

typedef struct ListedRay {
    ptb_float4 origin_left;     /* w: bits of the number of the triangle that it starts at, or TREE_NOTHING */
    ptb_float4 direction_reach; /* xyz: of length 1; w: what is farther is not met */
} ListedRay;
PTB_ASSERT_SIZE(ListedRay, 32);

typedef struct ListedHit {
    float distance;
    ptb_uint triangle; /* its number, or TREE_NOTHING */
    float b, c;        /* shares of its second and third corner in the point met */
} ListedHit;
PTB_ASSERT_SIZE(ListedHit, 16);

/* Which rays to make: number i of the list is of pixel i % pixels, sample i / pixels. */
typedef struct RaysMaking {
    PtbCamera camera;
    ptb_uint width; /* of the picture, in pixels; */
    ptb_uint pixels;
    ptb_uint first; /* numbers of the list, */
    ptb_uint end;   /* and the one after the last */
    ptb_uint run;   /* that a work-item makes */
    ptb_uint seed;
    ptb_uint grounds; /* surfaces on the way from the camera to where the ray starts */
    ptb_uint lamps;   /* triangles that it may lead to; 0: it leads anywhere */
} RaysMaking;
PTB_ASSERT_SIZE(RaysMaking, 96);

/* A ray to a lamp ends after this share of the way, well before what it leads to. */
#define RAYS_SHADOW_SHARE 0.999f

#endif
