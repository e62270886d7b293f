/* How likely a path is by the other of two strategies: lamps met from the camera by mirrors or glass, and matte surfaces shown to it
   that light came to so. Both trace the same segments but the camera's, and of each between matte surfaces the densities are the same
   from either end, the cosine's; so the odds are those of the camera's segment and of the lamp's point alone. A camera path keeps the
   former, for a density of 1 of the point; a light path the latter, for a density of 1 of the vertex shown. */
#ifndef PTB_PT_LT_ODDS_H
#define PTB_PT_LT_ODDS_H

#include "bdpt/vertex.h"
#include "pt_lt/work.h"

/* After a segment of camera paths. What a mirror or glass shows first no vertex of a light path is shown by: odds of 0. */
ALWAYS_INLINE void note_odds(const World* world, Path* path, const Hit* hit, Vec direction, const Sides* before,
                             lanes_mask alive COUNTED_PARAMETER) {
    (void)alive;
    const Surface surface = surface_of(&world->surfaces, hit_face(hit));
    COUNTED(scene_refracts(world->scene) ? counted_lanes(alive) : 0u, PT_LT_GLASS_WORK)
    if (scene_refracts(world->scene)) path->odds = path->odds * squeezed_by(&surface, path, before);
    const lanes_mask first = path->odds < 0.0f;
    if (!lanes_any(first)) return;
    COUNTED_LANES(alive & first, PT_LT_FIRST_WORK)
    COUNTED_CENTRES(path->ray, alive & first)
    const lanes_f distance = hit_distance(hit), axis_cosine = vec_dot(direction, vec_of(world->frame->axis_area));
    const lanes_f cosine = -vec_dot(matte_normal(path, &surface), direction) * chance_to_go_on(&surface);
    const lanes_f odds = distance * distance * inverse_of_frame(world->frame, axis_cosine) / cosine;
    const lanes_mask shown = (surface.mirrored == 0.0f) & (cosine > 0.0f);
    path->odds = lanes_select(path->odds, lanes_select((lanes_f)(0.0f), odds, shown), first);
}

/* Moves light paths to what they met, which is shown where it is matte. */
ALWAYS_INLINE Vertex move_to_shown(Path* path, const Arrival* met, lanes_mask alive COUNTED_PARAMETER) {
    Vertex vertex = move_there(path, met, alive);
    COUNTED_LANES(alive, PT_LT_VERTEX_WORK)
    COUNTED_CENTRES(path->ray, alive)
    vertex.odds = path->odds * met->goes_on;
    return vertex;
}

/* Light is squeezed where it passes glass, since radiance here is not scaled by the squared index of refraction. */
ALWAYS_INLINE lanes_mask bounce_light(const World* world, Path* path, const Arrival* met, lanes_mask alive COUNTED_PARAMETER) {
    const Vec draw = draw_bounce(&path->random);
    const Sides before = path->inside;
    (void)scatter(world->scene, &path->ray, &path->inside, &met->hit, &met->surface, &draw COUNTED_ARGUMENT);
    const lanes_mask goes_on = alive & !dies(path, met->goes_on);
    if (scene_refracts(world->scene)) {
        COUNTED_LANES(alive, BDPT_GLASS_WORK(true))
        const lanes_f factor = squeezed_by(&met->surface, path, &before);
        path->odds = path->odds * factor;
        path->throughput = vec_scale(path->throughput, factor);
    }
    return goes_on;
}

#endif
