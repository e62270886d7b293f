/* The path from a lamp, whose vertices are joined to those of the camera's. */
#ifndef PTB_BDPT_LIGHT_PATH_H
#define PTB_BDPT_LIGHT_PATH_H

#include "bdpt/lamp.h"

/* A light path has a segment less than a path. */
#define LIGHT_SEGMENTS (ENGINE_PATH_LENGTH - 1)
#define LIGHT_VERTICES (LIGHT_SEGMENTS > 0 ? LIGHT_SEGMENTS : 1)

/* Loops run to their end whichever lanes are alive, and are not unrolled: those of a warp that left one would not meet the others
   again before the sample's end. 2.0 -> 2.5 Gsamples/s; where lamps end many light paths, 0.33 -> 2.2 (H200). */

/* Traces a path that has left the lamp of this number. */
ALWAYS_INLINE void trace_light_path(const World* world, Path* path, Odds* odds, lanes_u number, lanes_mask alive, Vertex* light,
                                    Traced* traced COUNTED_PARAMETER) {
#pragma unroll 1
    for (uint i = 0u; i < LIGHT_SEGMENTS; ++i) {
        light[i].joins = lanes_none();
        if (!lanes_any(alive)) continue;
        const Arrival met = meet(world, path COUNTED_ARGUMENT);
        COUNTED_RAYS(world->scene, alive)
        traced->light_segments += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), alive);
        const lanes_f distance = hit_distance(&met.hit);
        const lanes_f last = i == 0u ? odds_of_asking(world, path, &met, odds, number, alive COUNTED_ARGUMENT)
                                     : odds->last * distance * distance;
        light[i] = move_to_vertex(path, &met, odds, last, alive COUNTED_ARGUMENT);
        alive = bounce(world, path, &met, odds, true, alive COUNTED_ARGUMENT);
    }
}

#endif
