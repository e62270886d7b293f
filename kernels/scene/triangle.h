/* Where a ray meets triangles, one or eight at once: see "Watertight Ray/Triangle Intersection", by S. Woop, C. Benthin and
   I. Wald. Corners are seen from the ray's origin and sheared, so that the ray is their third axis; then the signs of three
   edge functions say whether it goes through. An edge's function in one triangle is the negative of that in its neighbour,
   as long as no product is fused with the difference; so a ray at an edge meets one of the two at least. */
#ifndef PTB_SCENE_TRIANGLE_H
#define PTB_SCENE_TRIANGLE_H

#include "scene/scene.h"

#if SCENE_TREE == 8
typedef float8 tree_f;
typedef int8 tree_mask;
#else
typedef float tree_f;
typedef int tree_mask;
#endif

/* Two coordinates of a sheared corner. */
typedef struct Corner {
    tree_f x, y;
} Corner;

/* Edge functions of the edges opposite to a, b, c, and their sum: the share of each corner in the point met is its function
   over the sum. */
typedef struct Edges {
    tree_f a, b, c, sum;
} Edges;

static inline Edges edges_of(Corner a, Corner b, Corner c) {
#pragma OPENCL FP_CONTRACT OFF
    Edges e;
    e.a = c.x * b.y - c.y * b.x;
    e.b = a.x * c.y - a.y * c.x;
    e.c = b.x * a.y - b.y * a.x;
    e.sum = e.a + e.b + e.c;
    return e;
}

/* With a NaN, b. */
static inline tree_f tree_min(tree_f a, tree_f b) { return a < b ? a : b; }
static inline tree_f tree_max(tree_f a, tree_f b) { return a > b ? a : b; }

/* Of one instruction, where it does not matter which comes with a NaN. */
#if PTB_PTX
#define QUICK_MIN fmin
#define QUICK_MAX fmax
#else
#define QUICK_MIN tree_min
#define QUICK_MAX tree_max
#endif

/* Whether the ray goes through, from either side; not where the triangle is seen as a line, or is no triangle. */
static inline tree_mask goes_through(const Edges* e) {
    const tree_f least = QUICK_MIN(QUICK_MIN(e->a, e->b), e->c), most = QUICK_MAX(QUICK_MAX(e->a, e->b), e->c);
    return ((least >= 0.0f) | (most <= 0.0f)) & ((e->sum > 0.0f) | (e->sum < 0.0f));
}

static inline float largest_part(Vec a) { return fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z)); }

/* How far from its plane a point of a triangle is put. */
static inline float triangle_margin(const Vec corner[3]) {
    return TRIANGLE_MARGIN * fmax(fmax(largest_part(corner[0]), largest_part(corner[1])), largest_part(corner[2]));
}

/* A number that no direction is nearer to 0 than: so its inverse is finite, and no product with it is no number. */
#define TREE_LEAST_SLOPE 1e-18f

static inline float steep(float d) { return fabs(d) < TREE_LEAST_SLOPE ? copysign(TREE_LEAST_SLOPE, d) : d; }

/* The axis along which a direction goes furthest, 0 to 2. */
static inline uint main_axis(Vec d) {
    const float x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
    return z >= x && z >= y ? 2u : y >= x ? 1u : 0u;
}

#endif
