/* Lists of rays that meet a tree of triangles: `rays_meet`, what is nearest, and `rays_see`, whether anything is within reach,
   which are timed; `rays_make` makes the list before. A work-item takes `run` rays, one after the other. */
#ifndef SCENE_TREE
#define SCENE_TREE 2
#define TREE_STACK 64
#endif

#include "rays/make.h"
#include "rays/work.h"

/* A hit is written as one vector. */
static inline void meet_one(Tree tree, __global const ListedRay* ray, __global ListedHit* hit, const bool any COUNTED_PARAMETER) {
    COUNTED_SEGMENTS(1u)
    COUNTED(1u, RAYS_RAY_WORK)
    const float4 origin_left = ray->origin_left, direction_reach = ray->direction_reach;
    Search search;
    SearchStack stack;
    COUNTED_SEARCH
    search_begin(tree, &search, &stack, vec_of(origin_left), vec_of(direction_reach), direction_reach.w, as_uint(origin_left.w),
                 TREE_NOTHING COUNTED_ARGUMENT);
    search_all(tree, &search, &stack, any COUNTED_ARGUMENT);
    const Found found = search.found;
    uint triangle = TREE_NOTHING;
    if (found.place != TREE_NOTHING) {
        COUNTED(1u, RAYS_MET_WORK)
        triangle = triangle_number(tree, found.place);
    }
    *(__global float4*)hit = (float4)(found.distance, as_float(triangle), found.b, found.c);
}

RAYS_OUTLINE void meet_run(Tree tree, __global const ListedRay* rays, __global ListedHit* hits, uint first,
                           uint end COUNTED_PARAMETER) {
    RAYS_STAY_OUTLINED;
    for (uint i = first; i < end; ++i) meet_one(tree, rays + i, hits + i, false COUNTED_ARGUMENT);
}

RAYS_OUTLINE void see_run(Tree tree, __global const ListedRay* rays, __global ListedHit* hits, uint first,
                          uint end COUNTED_PARAMETER) {
    RAYS_STAY_OUTLINED;
    for (uint i = first; i < end; ++i) meet_one(tree, rays + i, hits + i, true COUNTED_ARGUMENT);
}

/* Meets the rays from number `first` to before `end`. */
__kernel void rays_meet(__global const float4* nodes, __global const float4* leaves, const TreeGrid grid, __global const ListedRay* rays,
                        __global ListedHit* hits, uint first, uint end, uint run COUNTED_ROWS) {
    COUNTED_BEGIN
    const Tree tree = {nodes, leaves, grid};
    const uint begin = min(first + (uint)get_global_id(0) * run, end);
    meet_run(tree, rays, hits, begin, min(begin + run, end) COUNTED_ARGUMENT);
    COUNTED_END
}

__kernel void rays_see(__global const float4* nodes, __global const float4* leaves, const TreeGrid grid, __global const ListedRay* rays,
                       __global ListedHit* hits, uint first, uint end, uint run COUNTED_ROWS) {
    COUNTED_BEGIN
    const Tree tree = {nodes, leaves, grid};
    const uint begin = min(first + (uint)get_global_id(0) * run, end);
    see_run(tree, rays, hits, begin, min(begin + run, end) COUNTED_ARGUMENT);
    COUNTED_END
}

/* Makes the rays of the list. `lamps`: corners of the triangles that shine. `missing` counts the rays that nothing was found
   to start from. */
__kernel void rays_make(__global const float4* nodes, __global const float4* leaves, const TreeGrid grid, __global const TreeTriangle* lamps,
                        __global ListedRay* rays, volatile __global uint* missing, const RaysMaking making) {
    const Tree tree = {nodes, leaves, grid};
    const uint begin = min(making.first + (uint)get_global_id(0) * making.run, making.end);
    const uint lost = make_run(tree, lamps, rays, begin, min(begin + making.run, making.end), making);
    if (lost > 0u) (void)atomic_add(missing, lost);
}
