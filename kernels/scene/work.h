/* The arithmetic of rays and bounces, for the build that counts: additions and multiplications, roots, divisions of one
   lane. Held against the instructions that Oclgrind sees by tests/render/counted.py. */
#ifndef PTB_SCENE_WORK_H
#define PTB_SCENE_WORK_H

#include "lib/counted.h"
#include "scene/scene.h"

/* vec_normalize: a scalar product, three products, and lib/roots.h's 1 / sqrt. */
#if PTB_PTX
#define SCENE_RSQRT_FLOPS 0u
#define SCENE_RSQRT_ROOTS 1u
#define SCENE_RSQRT_DIVISIONS 0u
#elif RSQRT_ESTIMATED
#define SCENE_RSQRT_FLOPS 5u /* an estimate, and a Newton step */
#define SCENE_RSQRT_ROOTS 0u
#define SCENE_RSQRT_DIVISIONS 0u
#else
#define SCENE_RSQRT_FLOPS 0u
#define SCENE_RSQRT_ROOTS 1u
#define SCENE_RSQRT_DIVISIONS 1u
#endif
#define SCENE_NORMALIZE_FLOPS (8u + SCENE_RSQRT_FLOPS)

/* lib/sphere_direction.h: z and the circle's radius there, sine and cosine. */
#if PTB_PTX
#define SCENE_SPHERE_FLOPS (3u + 3u)
#define SCENE_SPHERE_ROOTS (1u + 2u)
#else
#define SCENE_SPHERE_FLOPS (3u + 22u)
#define SCENE_SPHERE_ROOTS 1u
#endif

/* scene/hit.h: what a ray prepares; what a sphere costs, the move to the hit included where it carries gaps; what the zeros
   of centres save; what distant and vast spheres cost more. */
#define SCENE_ZEROS (popcount(SCENE_ZERO_X) + popcount(SCENE_ZERO_Y) + popcount(SCENE_ZERO_Z))
#ifdef SCENE_CARRIED
#define SCENE_LINE_FLOPS 5u
#define SCENE_TEST_FLOPS (6u + 2u + 1u + 4u)
#define SCENE_SAVED_FLOPS (2u * SCENE_ZEROS)
#else
#define SCENE_LINE_FLOPS 13u
#define SCENE_TEST_FLOPS (6u + 9u + 1u)
#define SCENE_SAVED_FLOPS (4u * SCENE_ZEROS)
#endif

#ifdef SCENE_CAREFUL_BEGIN
#define SCENE_DISTANT_ONES (SCENE_DISTANT_END - SCENE_DISTANT_BEGIN)
#define SCENE_VAST_ONES (SCENE_CAREFUL_END - SCENE_CAREFUL_BEGIN - SCENE_DISTANT_ONES)
#define SCENE_VAST_TWO_SIDED (SCENE_CAREFUL_END - SCENE_DISTANT_END)
#else
#define SCENE_VAST_TWO_SIDED 0u
#define SCENE_DISTANT_ONES 0u
#define SCENE_VAST_ONES 0u
#endif
#define SCENE_CARE_FLOPS (5u * SCENE_DISTANT_ONES + 2u * SCENE_VAST_ONES)

/* scene/scatter.h but for refraction: along, the normal's share and the sum; at spheres the move and the way from the centre.
   Where there are triangles, scene/meet.h counts what is of spheres alone. */
#define SCENE_MOVE_WORK 6u, 0u, 0u, 0u
#define SCENE_CENTRE_WORK 3u, 0u, 0u, 0u
#ifdef SCENE_TREE
#define SCENE_SCATTER_FLOPS (5u + 2u + 6u)
#define COUNTED_CENTRES(ray, lanes) COUNTED((ray).left == TREE_NOTHING ? 1u : 0u, SCENE_CENTRE_WORK)
#else
#define SCENE_SCATTER_FLOPS (6u + 3u + 5u + 2u + 6u)
#define COUNTED_CENTRES(ray, lanes) COUNTED_LANES(lanes, SCENE_CENTRE_WORK)
#endif

/* Bytes that rays read of global memory. Copies of the scene, made once a work-group or work-item, are not counted. */
#define SCENE_SPHERE_BYTES (SCENE_SPHERES == SCENE_IN_GLOBAL ? (uint)sizeof(SceneSphere) : 0u)
#define SCENE_SURFACE_BYTES(read) (SCENE_SURFACES == SCENE_IN_GLOBAL ? (read) : 0u)

/* Spheres whose root is an estimate and a Newton step, of 6 flops. */
#define SCENE_ESTIMATES(scene) (SQRT_ESTIMATED * ((scene).opaque / 2u))

/* A segment: what it meets, and the numbers of that surface; throughput, and the bounce there. */
#define SCENE_MEETING_WORK(scene)                                                                                     \
    (SCENE_LINE_FLOPS + (scene).count * SCENE_TEST_FLOPS + SCENE_ESTIMATES(scene) * 6u + SCENE_CARE_FLOPS -           \
     SCENE_SAVED_FLOPS), ((scene).count - SCENE_ESTIMATES(scene)), SCENE_VAST_ONES, SCENE_SURFACE_BYTES(48u)
#define SCENE_BOUNCE_WORK                                                                                             \
    (3u + SCENE_SCATTER_FLOPS + SCENE_SPHERE_FLOPS + SCENE_NORMALIZE_FLOPS), (SCENE_SPHERE_ROOTS + SCENE_RSQRT_ROOTS), \
        SCENE_RSQRT_DIVISIONS, 0u
/* The spheres, which all lanes of a work-item share. */
#define SCENE_STEP_WORK(spheres) 0u, 0u, 0u, (spheres) * SCENE_SPHERE_BYTES
/* Refraction, which every ray works out in scenes with two-sided spheres. */
#if defined(SCENE_FEW) && TABLE_PERMUTES
#define SCENE_REFRACTION_WORK 14u, 1u, 0u, 0u
#else
#define SCENE_REFRACTION_WORK 13u, 1u, 0u, 0u
#endif

/* A shadow ray, scene/hit.h's sees. */
#ifdef SCENE_CARRIED
#define SCENE_SEES_FLOPS (6u + 2u + 2u)
#else
#define SCENE_SEES_FLOPS (6u + 7u + 2u + 2u)
#endif
#define SCENE_SHADOW_WORK(scene)                                                                                        \
    (SCENE_LINE_FLOPS + (scene).count * SCENE_SEES_FLOPS + two_sided_spheres(scene) * 2u + 5u * SCENE_DISTANT_ONES + \
     2u * SCENE_VAST_ONES + SCENE_VAST_TWO_SIDED - SCENE_SAVED_FLOPS), 0u, 0u, 0u

/* scene/search.h: a ray's preparation; a node, a triangle, and one that the ray goes through. scene/meet.h: the point met,
   and the step through a dielectric. */
#ifdef SCENE_TREE
#if SCENE_TREE == 8
#define TREE_AIM_WORK 7u, 0u, 4u, 0u
#define TREE_NODE_WORK (8u * 6u * 2u), 0u, 0u, (uint)sizeof(TreeNode8)
#define TREE_TRIANGLE_WORK (9u + 6u * 2u + 11u), 0u, 0u, (3u * 3u * 4u)
#define TREE_POINT_WORK 21u, 0u, 1u, 4u
#else
#ifdef TREE_QUANTISED
#define TREE_AIM_WORK (15u + 21u), 0u, 4u, 0u
#define TREE_NODE_WORK (2u * 6u * 2u), 0u, 0u, (uint)sizeof(TreeNode2q)
#else
#define TREE_AIM_WORK 15u, 0u, 4u, 0u
#define TREE_NODE_WORK (2u * 9u * 2u), 0u, 0u, (uint)sizeof(TreeNode2)
#endif
#define TREE_TRIANGLE_WORK (6u * 6u + 11u), 0u, 0u, (uint)sizeof(TreeTriangle)
#define TREE_POINT_WORK 28u, 0u, 1u, 0u
#endif
#define TREE_MET_WORK (6u + 5u + 1u + 12u + 6u), 0u, 0u, (uint)(sizeof(TreeTriangle) + sizeof(SceneTriangle))
#define TREE_PASS_WORK 7u, 0u, 0u, 0u
/* A point of a triangle that shines, where it is asked for and where a path starts; a way that ends there. */
#define LAMP_SPREAD_FLOPS (2u + 1u + 6u + 1u + 12u)
#define LAMP_TRIANGLE_WORK (LAMP_SPREAD_FLOPS + 3u + 5u + SCENE_RSQRT_FLOPS + 3u + 1u + 1u + 1u + 5u), (1u + SCENE_RSQRT_ROOTS), \
        SCENE_RSQRT_DIVISIONS, (uint)(sizeof(TreeTriangle) + sizeof(SceneTriangle)) + LAMP_BYTES
#define LAMP_SIDE_WORK (LAMP_SPREAD_FLOPS + 3u + 1u + 6u + 1u), 1u, 0u, (uint)sizeof(TreeTriangle)
#define LAMP_FLAT_WORK (2u + 5u), 0u, 0u, LAMP_BYTES
#endif

/* scene/lamps.h: a direction of a cone, */
#define LAMP_CONE_FLOPS (5u + (SCENE_SPHERE_FLOPS - 3u) + 29u + SCENE_RSQRT_FLOPS)
#define LAMP_CONE_ROOTS (SCENE_SPHERE_ROOTS + SCENE_RSQRT_ROOTS)
/* what a point knows of a lamp, and what more it has to when it is near, */
#define LAMP_SIGHT_WORK 8u, 0u, 0u, LAMP_BYTES
#define LAMP_NEAR_WORK (9u + 2u * SCENE_RSQRT_FLOPS), (1u + 2u * SCENE_RSQRT_ROOTS), (2u * SCENE_RSQRT_DIVISIONS), 0u
/* a point of a cap, a direction of the cone that a near point sees, and both densities. */
#define LAMP_CAP_WORK (LAMP_CONE_FLOPS + 20u + SCENE_RSQRT_FLOPS), (LAMP_CONE_ROOTS + SCENE_RSQRT_ROOTS), (2u * SCENE_RSQRT_DIVISIONS), 0u
#define LAMP_DIRECTION_WORK (LAMP_CONE_FLOPS + 19u), (LAMP_CONE_ROOTS + 1u), SCENE_RSQRT_DIVISIONS, 0u
#define LAMP_DENSITY_WORK 2u, 0u, 0u, 0u
#define LAMP_WAY_WORK 8u, 0u, 0u, 0u
/* a point where a path starts. */
#define LAMP_POINT_WORK (LAMP_CONE_FLOPS + 6u), LAMP_CONE_ROOTS, SCENE_RSQRT_DIVISIONS, 0u
#define LAMP_CHOICE_WORK 3u, 0u, 0u, 20u
#ifdef SCENE_LONE_LAMP
#define LAMP_BYTES 0u
#elif defined(SCENE_TREE)
#define LAMP_BYTES 68u
#else
#define LAMP_BYTES 64u
#endif

#endif
