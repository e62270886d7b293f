/* `pt_lt`: `pt_nee` with light tracing of caustics. Light that comes from a lamp by mirrors or glass to a matte surface is found by
   no shadow ray; so paths start at lamps, too, see "Robust Monte Carlo Methods for Light Transport Simulation", by E. Veach, and
   those that meet a mirror or glass first are shown to the camera at every matte surface from there on. */
#define PATH_ASKS
#define ENGINE_SPLATS
#define PATH_ODDS
#include "bdpt/join.h"
#include "bdpt/lamp.h"
#include "pt_nee/segment.h"
#include "pt_lt/odds.h"

static inline lanes_mask trace_segment(const World* world, Path* path, const Hit* hit, lanes_mask alive,
                                       uint turn COUNTED_PARAMETER) {
    const Vec direction = path->ray.direction;
    const Sides before = path->inside;
    const lanes_mask over = trace_asking(world, path, hit, alive, turn COUNTED_ARGUMENT);
    note_odds(world, path, hit, direction, &before, alive COUNTED_ARGUMENT);
    return over;
}

/* Starts these paths at points of lamps. */
static inline void leave_lamps(const World* world, Path* path, lanes_mask fresh COUNTED_PARAMETER) {
    Odds odds;
    (void)leave_lamp(world, path, &odds, fresh COUNTED_ARGUMENT);
    COUNTED_LANES(fresh, PT_LT_START_WORK)
    path->odds = odds.earlier * (1.0f / PI);
}

/* Traces a segment of every path from a lamp, `fresh` ones' first, and shows what it meets to the camera; returns the lanes that
   may go on. */
static inline lanes_mask trace_light_segment(const World* world, const Picture* picture, Path* path, lanes_mask fresh,
                                             lanes_mask alive, const Sides* of_camera, Traced* traced COUNTED_PARAMETER) {
    const Arrival met = meet(world, path COUNTED_ARGUMENT);
    COUNTED_MEETING(world->scene, alive)
    traced->light_segments += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), alive);
    const lanes_mask useful = alive & !(fresh & met.matte) & !met.ends;
    if (!lanes_any(useful)) return useful;
    COUNTED_BOUNCE(world->scene, useful)
    const Vertex vertex = move_to_shown(path, &met, useful COUNTED_ARGUMENT);
    show(world, picture, &vertex, of_camera, traced COUNTED_ARGUMENT);
    return bounce_light(world, path, &met, useful COUNTED_ARGUMENT);
}

#define INTEGRATOR pt_lt
#include "engine/trace.h"
#include "engine/kernels.h"
