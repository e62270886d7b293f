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

#endif
