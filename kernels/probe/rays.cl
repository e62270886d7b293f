/* `probe_rays`: what a list of rays meets in a tree of triangles, and `probe_sights`: whether they meet anything. Each
   work-item takes `run` rays, one after the other. */
#ifndef SCENE_TREE
#define SCENE_TREE 2
#define TREE_STACK 64
#endif

#include "lib/outlined.h"
#include "scene/search.h"
#include "shared/rays.h"

#ifdef ENGINE_ALONE
#define RAYS_OUTLINE OUTLINED
#define RAYS_STAY_OUTLINED STAY_OUTLINED
#else
#define RAYS_OUTLINE static inline
#define RAYS_STAY_OUTLINED (void)0
#endif

static inline ProbeHit met_by(Tree tree, ProbeRay ray, const bool any COUNTED_PARAMETER) {
    Search search;
    COUNTED_SEARCH
    search_begin(&search, vec_of(ray.origin_left), vec_of(ray.direction_reach), ray.direction_reach.w,
                 as_uint(ray.origin_left.w), TREE_NOTHING COUNTED_ARGUMENT);
    search_all(tree, &search, any COUNTED_ARGUMENT);
    const Found found = search.found;
    ProbeHit hit = {found.distance, TREE_NOTHING, found.b, found.c};
    Vec corner[3];
    if (found.place != TREE_NOTHING) hit.triangle = triangle_at(tree, found.place, corner);
    return hit;
}

RAYS_OUTLINE void meet_run(Tree tree, __global const ProbeRay* rays, __global ProbeHit* hits, uint first,
                           uint end COUNTED_PARAMETER) {
    RAYS_STAY_OUTLINED;
    for (uint i = first; i < end; ++i) hits[i] = met_by(tree, rays[i], false COUNTED_ARGUMENT);
}

RAYS_OUTLINE void see_run(Tree tree, __global const ProbeRay* rays, __global ProbeHit* hits, uint first,
                          uint end COUNTED_PARAMETER) {
    RAYS_STAY_OUTLINED;
    for (uint i = first; i < end; ++i) hits[i] = met_by(tree, rays[i], true COUNTED_ARGUMENT);
}

__kernel void probe_rays(__global const float4* nodes, __global const float4* leaves, __global const ProbeRay* rays,
                         __global ProbeHit* hits, uint count, uint run COUNTED_ROWS) {
    COUNTED_BEGIN
    const Tree tree = {nodes, leaves};
    const uint first = (uint)get_global_id(0) * run;
    meet_run(tree, rays, hits, min(first, count), min(first + run, count) COUNTED_ARGUMENT);
    COUNTED_END
}

__kernel void probe_sights(__global const float4* nodes, __global const float4* leaves, __global const ProbeRay* rays,
                           __global ProbeHit* hits, uint count, uint run COUNTED_ROWS) {
    COUNTED_BEGIN
    const Tree tree = {nodes, leaves};
    const uint first = (uint)get_global_id(0) * run;
    see_run(tree, rays, hits, min(first, count), min(first + run, count) COUNTED_ARGUMENT);
    COUNTED_END
}
