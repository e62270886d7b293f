/* The arithmetic of the engine's steps, for the build that counts; see scene/work.h. */
#ifndef PTB_ENGINE_WORK_H
#define PTB_ENGINE_WORK_H

#include "engine/path.h"
#include "scene/work.h"

/* Where in its pixel a sample lies, and in the image. */
#if defined(ENGINE_FILTER) && ENGINE_FILTER == ENGINE_CENTRE
#define ENGINE_PLACE_FLOPS 2u
#elif defined(ENGINE_FILTER) && ENGINE_FILTER == ENGINE_STRATIFIED
#define ENGINE_PLACE_FLOPS 11u
#else
#define ENGINE_PLACE_FLOPS 2u
#endif

/* Radiance asked for: at each segment, or once a path. */
#ifdef PATH_GATHERS
#define ENGINE_GATHER_WORK 6u, 0u, 0u, SCENE_SURFACE_BYTES(12u)
#define ENGINE_END_FLOPS 0u
#define ENGINE_END_BYTES 0u
#else
#define ENGINE_GATHER_WORK 0u, 0u, 0u, 0u
#define ENGINE_END_FLOPS 3u
#define ENGINE_END_BYTES SCENE_SURFACE_BYTES(12u)
#endif

/* A path: its radiance and square added, and the next one's camera ray. */
#define ENGINE_PATH_WORK                                                                                 \
    (ENGINE_END_FLOPS + 9u + ENGINE_PLACE_FLOPS + 12u + SCENE_NORMALIZE_FLOPS), SCENE_RSQRT_ROOTS,       \
        SCENE_RSQRT_DIVISIONS, ENGINE_END_BYTES
/* A look for a unit, of use or not: its place, and its run. */
#define ENGINE_TAKE_WORK 4u, 0u, 0u, 2u * (uint)sizeof(uint)
/* A unit: its tally. */
#define ENGINE_UNIT_WORK 0u, 0u, 0u, (uint)sizeof(Tally)
/* A tally added to a pixel of the film: its numbers scaled. */
#define ENGINE_ADD_WORK 6u, 0u, 0u, (uint)sizeof(Tally)
#define ENGINE_PIXEL_WORK 0u, 0u, 0u, 2u * (uint)sizeof(FilmPixel)

/* What a sample adds to another pixel: its numbers scaled. */
#define ENGINE_SPLAT_WORK 3u, 0u, 0u, 0u

/* Of a picture's gradients: a sample added to its unit's, and numbers that are added, scaled. */
#define ENGINE_GRADIENTS_WORK (4u * (6u + 5u) + 5u), 0u, 0u, 0u
#define ENGINE_GRADIENT_WORK 4u, 0u, 0u, 0u
#define ENGINE_TOWARD_WORK 3u, 0u, 0u, 0u
#define ENGINE_NEIGHBOUR_WORK(neighbour) ((neighbour) < 2u ? 1u : 0u), 0u, 0u, 0u

/* engine/light.h: what is met, and its share; a lamp's cosine at a surface, the weight of its light, and that light. */
#define LIGHT_MET_WORK 9u, 0u, 0u, SCENE_SURFACE_BYTES(12u)
#ifdef PATH_ODDS
#define LIGHT_SHARE_WORK 5u, 0u, 2u, 0u
#else
#define LIGHT_SHARE_WORK 3u, 0u, 1u, 0u
#endif
#define LIGHT_TRIANGLE_WORK (7u + 1u), 0u, 0u, 0u
#define LIGHT_COSINE_WORK 8u, 0u, 0u, 0u
#define LIGHT_WEIGHT_WORK 7u, 0u, 1u, 0u
/* Light that is sent, and is awaited first where paths wait. */
#if PATH_WAITS
#define LIGHT_SENT_WORK 3u, 0u, 0u, 0u
#define LIGHT_ARRIVES_WORK 3u, 0u, 0u, 0u
#else
#define LIGHT_SENT_WORK 6u, 0u, 0u, 0u
#endif
/* Roulette: the chance, and the throughput and comparison. */
#ifdef ENGINE_ROULETTE
#define ENGINE_ROULETTE_WORK 7u, 0u, 1u, 0u
#else
#define ENGINE_ROULETTE_WORK 0u, 0u, 0u, 0u
#endif

/* A segment of every path that is alive, what it gathers aside; and of paths that no picture counts. */
#define COUNTED_SEGMENT(scene, alive)                                                                    \
    COUNTED_SEGMENTS(counted_lanes(alive))                                                               \
    COUNTED_RAYS(scene, alive)
#define COUNTED_RAYS(scene, alive)                                                                       \
    COUNTED_MEETING(scene, alive)                                                                        \
    COUNTED_BOUNCE(scene, alive)
#define COUNTED_MEETING(scene, alive)                                                                    \
    COUNTED(1u, SCENE_STEP_WORK((scene).count))                                                          \
    COUNTED_LANES(alive, SCENE_MEETING_WORK(scene))
#define COUNTED_BOUNCE(scene, alive)                                                                     \
    COUNTED_LANES(alive, SCENE_BOUNCE_WORK)                                                              \
    COUNTED(scene_refracts(scene) ? counted_lanes(alive) : 0u, SCENE_REFRACTION_WORK)                    \
    COUNTED_LANES(alive, ENGINE_ROULETTE_WORK)
/* The density of a bounce's direction. */
#ifdef ENGINE_ROULETTE
#define LIGHT_BOUNCE_WORK 1u, 0u, 1u, 0u
#else
#define LIGHT_BOUNCE_WORK 1u, 0u, 0u, 0u
#endif

#endif
