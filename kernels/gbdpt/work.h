/* The arithmetic of shifted paths, for the build that counts; see bdpt/work.h. */
#ifndef PTB_GBDPT_WORK_H
#define PTB_GBDPT_WORK_H

#include "bdpt/work.h"

/* The direction through a neighbouring pixel. */
#define GBDPT_DIRECTION_WORK (14u + SCENE_NORMALIZE_FLOPS), SCENE_RSQRT_ROOTS, (2u + SCENE_RSQRT_DIVISIONS), 0u
/* Glass: its reflectance; the chance of a way, and a ray sent on that way. */
#define GBDPT_REFLECTANCE_FLOPS 13u
#define GBDPT_CHANCE_WORK (GBDPT_REFLECTANCE_FLOPS + 2u), 1u, 2u, 0u
#define GBDPT_PASS_WORK 6u, 1u, 0u, 0u
/* A shifted path's step to what it meets, and on from there. */
#define GBDPT_FOLLOW_WORK (9u + 10u + BDPT_ODDS_FLOPS + 5u + 9u + 6u + SCENE_NORMALIZE_FLOPS + 3u + 1u + GBDPT_ROULETTE_FLOPS), \
        SCENE_RSQRT_ROOTS, (1u + BDPT_ODDS_DIVISIONS + SCENE_RSQRT_DIVISIONS + GBDPT_ROULETTE_DIVISIONS), 0u
#define GBDPT_FIRST_WORK 5u, 0u, 0u, 0u
#ifdef ENGINE_ROULETTE
#define GBDPT_ROULETTE_FLOPS 3u
#define GBDPT_ROULETTE_DIVISIONS 1u
#else
#define GBDPT_ROULETTE_FLOPS 0u
#define GBDPT_ROULETTE_DIVISIONS 0u
#endif
/* Radiance met, whether there is any, and a lamp's share of the densities. */
#define GBDPT_SHINE_WORK 5u, 0u, 0u, SCENE_SURFACE_BYTES(12u)
#define GBDPT_LAMP_WORK 6u, 0u, 1u, 0u
#define GBDPT_MEETS_WORK 8u, 0u, 0u, SCENE_SURFACE_BYTES(12u)
/* A difference; light that both paths share, of the base path and of one shifted. */
#define GBDPT_DIFFERENCE_WORK 10u, 0u, 1u, 0u
#define GBDPT_SHARED_WORK 6u, 0u, 1u, 0u
#define GBDPT_OFFSET_WORK 10u, 0u, 1u, 0u
/* A shifted path joined to the base path, */
#define GBDPT_BASE_WAY_WORK (3u + 3u + 5u + SCENE_RSQRT_FLOPS + 1u + 3u + 16u), SCENE_RSQRT_ROOTS, SCENE_RSQRT_DIVISIONS, 0u
#define GBDPT_BASE_WORK (5u + 2u + 1u + 3u + 1u), 0u, 3u, 0u
#define GBDPT_BASE_ODDS_WORK (8u + 1u), 0u, 2u, 0u
#define GBDPT_BASE_SHINE_WORK 8u, 0u, 1u, 0u
#define GBDPT_BASE_LAMP_WORK 5u, 0u, 1u, 0u
/* to a vertex of the light path, and to a point of a lamp; */
#define GBDPT_WAY_WORK (3u + 5u + SCENE_RSQRT_FLOPS + 3u + 10u), SCENE_RSQRT_ROOTS, SCENE_RSQRT_DIVISIONS, 0u
#define GBDPT_DISTANCE_WORK 1u, 0u, 0u, 0u
#define GBDPT_JOIN_WORK (3u + 7u + 6u), 0u, 0u, 0u
#define GBDPT_ASKED_WORK (3u + 6u + 5u + 2u), 0u, 1u, 0u
#define GBDPT_ASK_WAY_WORK (3u + 5u + SCENE_RSQRT_FLOPS + 1u + 3u + 5u + 3u + 5u), SCENE_RSQRT_ROOTS, SCENE_RSQRT_DIVISIONS, 0u
#define GBDPT_ASK_WORK 17u, 0u, 2u, 0u
/* the base path's own sums there, beside bdpt's. */
#define GBDPT_OWN_JOIN_WORK 17u, 0u, 0u, 0u
#define GBDPT_OWN_ASK_WORK 15u, 0u, 1u, 0u
#define GBDPT_ADD_OWN_WORK 6u, 0u, 1u, 0u
/* A vertex that is shown, and that of a neighbouring pixel. */
#define GBDPT_PREVIOUS_LAMP_WORK 3u, 0u, 0u, 0u
#define GBDPT_PREVIOUS_WORK 4u, 0u, 1u, 0u
#define GBDPT_SHOW_WORK 8u, 0u, 1u, 0u
#define GBDPT_GEOMETRY_WORK (3u + 5u + SCENE_RSQRT_FLOPS + 5u + 5u + 5u), SCENE_RSQRT_ROOTS, SCENE_RSQRT_DIVISIONS, 0u
#define GBDPT_SHOWN_WORK (6u + 4u), 0u, 1u, 0u
#define GBDPT_VIEW_WORK (5u + 3u + 6u + 3u + 6u + 3u + 3u + 5u + SCENE_RSQRT_FLOPS + 3u + 10u + 4u), \
        SCENE_RSQRT_ROOTS, SCENE_RSQRT_DIVISIONS, 0u
#define GBDPT_VIEW_WEIGHT_WORK (1u + 3u + 5u + 5u + 3u + 7u + 3u), 0u, 3u, 0u
#define GBDPT_VIEW_LAMP_WORK 2u, 0u, 1u, 0u
#define GBDPT_VIEW_VERTEX_WORK 0u, 0u, 1u, 0u
/* What is met at first; the squared index of all shifted paths; the cosine at what is met. */
#define GBDPT_MET_WORK 6u, 0u, 0u, 0u
#define GBDPT_SQUEEZED_WORK 4u, 0u, 0u, 0u
#define GBDPT_ALONG_WORK 8u, 0u, 0u, 0u
/* The end of a sample: what is shared, times what it is worth. */
#define GBDPT_END_WORK (6u + 4u * 9u), 0u, 0u, 0u

#endif
