/* The arithmetic of the steps of both ends, for the build that counts; see engine/work.h. */
#ifndef PTB_BDPT_WORK_H
#define PTB_BDPT_WORK_H

#include "engine/work.h"

/* A camera path: the density of its direction. A light path: a direction, but for the point of the lamp, and the sides. */
#define BDPT_CAMERA_WORK 8u, 0u, 0u, 0u
#define BDPT_START_WORK(two_sided)                                                                        \
    (SCENE_SPHERE_FLOPS + 9u + SCENE_NORMALIZE_FLOPS + (two_sided) * 9u),                                 \
        (SCENE_SPHERE_ROOTS + SCENE_RSQRT_ROOTS), (SCENE_RSQRT_DIVISIONS + 1u),                           \
        (LAMP_BYTES + BDPT_CHOICE_BYTES + SCENE_SURFACE_BYTES(48u) * (two_sided))
#ifdef SCENE_LONE_LAMP
#define BDPT_CHOICE_BYTES 0u
#else
#define BDPT_CHOICE_BYTES 20u
#endif
/* What its first surface knows of the lamp, the density of asking it aside, but no squared distance. */
#define BDPT_FIRST_WORK (10u - 2u), 0u, 1u, 0u
/* A vertex but for the way from a sphere's centre, with the squared distance of the way there. */
#define BDPT_VERTEX_WORK (9u + BDPT_ODDS_FLOPS), 0u, BDPT_ODDS_DIVISIONS, 0u
#if BDPT_ENDS == 2
#define BDPT_ODDS_FLOPS 7u
#define BDPT_ODDS_DIVISIONS 1u
#define BDPT_EARLIER_FLOPS 2u
#else
#define BDPT_ODDS_FLOPS 0u
#define BDPT_ODDS_DIVISIONS 0u
#define BDPT_EARLIER_FLOPS 0u
#endif
/* The odds after a bounce, and where there is glass. */
#ifdef ENGINE_ROULETTE
#define BDPT_BOUNCE_WORK (2u + BDPT_EARLIER_FLOPS), 0u, 1u, 0u
#else
#define BDPT_BOUNCE_WORK (2u + BDPT_EARLIER_FLOPS), 0u, 0u, 0u
#endif
#define BDPT_GLASS_WORK(carries) ((carries) ? 4u : 1u), 0u, 0u, 0u

/* The way from a vertex to another, and to the camera with its pixel; */
#define BDPT_WAY_WORK (21u + SCENE_RSQRT_FLOPS), SCENE_RSQRT_ROOTS, SCENE_RSQRT_DIVISIONS, 0u
#define BDPT_PIXEL_WORK (38u + SCENE_RSQRT_FLOPS), SCENE_RSQRT_ROOTS, (SCENE_RSQRT_DIVISIONS + 1u), 0u
/* what is sent along it, and its share. */
#define BDPT_JOIN_WORK 18u, 0u, 1u, 0u
#define BDPT_SHOW_WORK 11u, 0u, 1u, 0u
/* A lamp that is asked, and one that is met. */
#define BDPT_COSINE_WORK 5u, 0u, 0u, 0u
#define BDPT_ASK_WORK 15u, 0u, 1u, 0u
#define BDPT_MET_WORK 7u, 0u, 1u, 0u

#endif
