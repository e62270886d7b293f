/* Vertices of both ends joined: by a shadow ray, with the share that this strategy has of all that make the same path. */
#ifndef PTB_BDPT_JOIN_H
#define PTB_BDPT_JOIN_H

#include "bdpt/vertex.h"

/* The lanes whose vertex sees, in this direction and at this distance, the surface of this face. */
ALWAYS_INLINE lanes_mask sees_from(const World* world, const Vertex* vertex, Vec direction, lanes_f distance, lanes_u face,
                                   lanes_mask wanted, Traced* traced COUNTED_PARAMETER) {
    COUNTED(counted_lanes(wanted) > 0u ? 1u : 0u, SCENE_STEP_WORK(world->scene.count))
    COUNTED_LANES(wanted, SCENE_SHADOW_WORK(world->scene))
    Ray shadow;
    start_at(&shadow, vertex->face);
    shadow.origin = vertex->position;
    shadow.direction = direction;
    traced->shadow_rays += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), wanted);
    return wanted & sees(world->scene, &shadow, &vertex->inside, distance, face COUNTED_ARGUMENT);
}

/* Adds what a vertex of the light path sends by way of one of the camera's. With the geometry g, the cosines over the squared
   distance, the sum is worth g and weighs 1 / (1 + g k), k being the odds of all other strategies. */
ALWAYS_INLINE void join(const World* world, Path* path, const Vertex* view, const Vertex* light, Traced* traced COUNTED_PARAMETER) {
    const lanes_mask joins = view->joins & light->joins;
    if (!lanes_any(joins)) return;
    const Vec way = vec_sub(light->position, view->position);
    const lanes_f squared = vec_dot(way, way), inverse = lanes_rsqrt(squared);
    const Vec direction = vec_scale(way, inverse);
    const lanes_f cosine = vec_dot(view->normal, direction), of_light = -vec_dot(light->normal, direction);
    COUNTED_LANES(joins, BDPT_WAY_WORK)
    const lanes_mask wanted = joins & (cosine > 0.0f) & (of_light > 0.0f) &
                              !sides_differ(&view->inside, &light->inside);
    if (!lanes_any(wanted)) return;
    COUNTED_LANES(wanted, BDPT_JOIN_WORK)
    const lanes_f g = cosine * of_light * inverse * inverse;
    const lanes_f share = g / (1.0f + g * (view->density * light->odds + light->density * view->odds));
    const lanes_mask seen =
        sees_from(world, view, direction, squared * inverse, light->face, wanted, traced COUNTED_ARGUMENT);
    const Vec sent = vec_mul(light->weight, view->weight);
    path->radiance = vec_select(path->radiance, vec_add_scaled(path->radiance, sent, share), seen);
}

/* Adds what a vertex of the light path sends to the camera itself, where the picture shows it. */
ALWAYS_INLINE void show(const World* world, const Picture* picture, const Vertex* light, const Sides* of_camera,
                        Traced* traced COUNTED_PARAMETER) {
    if (!lanes_any(light->joins)) return;
    const Vec way = vec_sub(vec_of(picture->camera), light->position);
    const lanes_f squared = vec_dot(way, way), inverse = lanes_rsqrt(squared);
    const Vec direction = vec_scale(way, inverse), from_camera = vec_scale(direction, (lanes_f)(-1.0f));
    const lanes_f of_light = vec_dot(light->normal, direction), cosine = vec_dot(from_camera, vec_of(picture->frame.axis_area));
    COUNTED_LANES(light->joins, BDPT_PIXEL_WORK)
    lanes_u pixel;
    const lanes_mask within = pixel_of(picture, from_camera, cosine, &pixel);
    const lanes_mask wanted =
        light->joins & within & (of_light > 0.0f) & !sides_differ(&light->inside, of_camera);
    if (!lanes_any(wanted)) return;
    COUNTED_LANES(wanted, BDPT_SHOW_WORK)
    const lanes_f g = of_light * inverse * inverse;
    const lanes_f share = g / (inverse_of_picture(picture, cosine) + g * light->odds);
    const lanes_mask seen =
        sees_from(world, light, direction, squared * inverse, (lanes_u)(SEES_POINT), wanted, traced COUNTED_ARGUMENT);
    splat(picture, pixel, vec_scale(light->weight, share), seen COUNTED_ARGUMENT);
}

/* Adds the light of a lamp that a vertex of the camera's path asks for it. */
ALWAYS_INLINE void ask(const World* world, Path* path, const Vertex* view, Traced* traced COUNTED_PARAMETER) {
    const LampDraw draw = draw_lamp(&path->random);
    if (!lanes_any(view->joins)) return;
    const LampSample lamp = sample_lamp(world->scene, &world->lamps, view->position, &draw, view->joins COUNTED_ARGUMENT);
    const lanes_f cosine = vec_dot(view->normal, lamp.direction);
    COUNTED_LANES(view->joins, BDPT_COSINE_WORK)
    const lanes_mask wanted = view->joins & (cosine > 0.0f) & (lamp.density.whole > 0.0f);
    if (!lanes_any(wanted)) return;
    COUNTED_LANES(wanted, BDPT_ASK_WORK)
    const lanes_f whole = cosine * lamp.density.whole;
    const lanes_f others = view->density + lamp.area_density * (1.0f / PI) * view->odds;
    const lanes_f share = whole / (lamp.density.part + whole * others);
    const lanes_mask seen =
        sees_from(world, view, lamp.direction, lamp.distance, lamp.face, wanted, traced COUNTED_ARGUMENT);
    const Vec sent = vec_mul(lamp.radiance, view->weight);
    path->radiance = vec_select(path->radiance, vec_add_scaled(path->radiance, sent, share), seen);
}

/* The share of the light of a lamp that the camera's path met: all of it where no other strategy makes the path. */
ALWAYS_INLINE lanes_f share_of_meeting(const World* world, const Path* path, const Arrival* met, const Odds* odds,
                                       lanes_mask alive COUNTED_PARAMETER) {
    lanes_u number;
    const lanes_mask is_lamp = lamp_met(world, met->face, &number);
    if (!lanes_any(alive & is_lamp)) return (lanes_f)(1.0f);
    const LampMet lamp = lamp_at(world, path, &met->hit, number, alive & is_lamp COUNTED_ARGUMENT);
    COUNTED_LANES(alive & is_lamp, BDPT_MET_WORK)
    const lanes_f whole = lamp.asked.whole + 1e-30f; /* 1 where there is no other, even at a cap's horizon */
    const lanes_f others = whole * (lamp.area_density * (1.0f / PI)) * odds->earlier + odds->last * lamp.asked.part;
    return lanes_select((lanes_f)(1.0f), whole / (whole + others), is_lamp);
}

#endif
