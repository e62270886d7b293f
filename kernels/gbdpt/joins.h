/* The strategies of bdpt/join.h that a camera path's vertices have, of a path and of those shifted from it. */
#ifndef PTB_GBDPT_JOINS_H
#define PTB_GBDPT_JOINS_H

#include "gbdpt/offset.h"

/* Joins the shifted path's first matte vertex to a vertex of the light path: what that is worth, and its density by all strategies,
   in units of the base path's density; nothing where they do not see each other. */
ALWAYS_INLINE void join_first(const World* world, Offset* offset, Vec* toward, const Vertex* light, Vec own, lanes_f sum,
                              lanes_mask counts, Traced* traced COUNTED_PARAMETER) {
    const Vec nothing = vec_of((float4)(0.0f));
    if (!lanes_any(counts & offset->follows)) {
        add_difference(toward, own, sum, nothing, (lanes_f)(0.0f), counts COUNTED_ARGUMENT);
        return;
    }
    COUNTED_LANES(counts & offset->follows, GBDPT_WAY_WORK)
    const Vertex first = first_vertex(offset), *view = &first;
    const Way way = way_to(view, light->position, light->normal);
    const lanes_mask wanted = counts & offset->follows & way_faces(&way, &view->inside, &light->inside);
    lanes_mask seen = lanes_none();
    if (lanes_any(wanted)) {
        COUNTED_LANES(wanted, GBDPT_DISTANCE_WORK)
        seen = sees_from(world, view, way.direction, way.squared * way.inverse, light->face, wanted, traced COUNTED_ARGUMENT);
    }
    if (!lanes_any(seen)) {
        add_difference(toward, own, sum, nothing, (lanes_f)(0.0f), counts COUNTED_ARGUMENT);
        return;
    }
    COUNTED_LANES(seen, GBDPT_JOIN_WORK)
    const lanes_f likelihood = lanes_select((lanes_f)(0.0f), offset->likelihood, seen);
    const lanes_f g = way_geometry(&way);
    const Vec other = vec_scale(vec_mul(light->weight, view->weight), g * likelihood);
    const lanes_f other_sum = likelihood * (1.0f + g * (view->density * light->odds + light->density * view->odds));
    add_difference(toward, own, sum, vec_select(nothing, other, seen), lanes_select((lanes_f)(0.0f), other_sum, seen),
                   counts COUNTED_ARGUMENT);
}

/* Adds what a vertex of the light path sends by way of one of the camera's; see bdpt/join.h. */
ALWAYS_INLINE void join_shifted(const World* world, Path* path, const Vertex* view, const Vertex* light, Base* base, Offset* offsets,
                                Gradients* gradients, lanes_mask first, Traced* traced COUNTED_PARAMETER) {
    const lanes_mask joins = view->joins & light->joins;
    if (!lanes_any(joins)) return;
    const Way way = way_to(view, light->position, light->normal);
    COUNTED_LANES(joins, BDPT_WAY_WORK)
    const lanes_mask wanted = joins & way_faces(&way, &view->inside, &light->inside);
    if (!lanes_any(wanted)) return;
    COUNTED_LANES(wanted, GBDPT_OWN_JOIN_WORK)
    const lanes_f g = way_geometry(&way);
    const lanes_f sum = 1.0f + g * (view->density * light->odds + light->density * view->odds);
    const lanes_mask seen =
        sees_from(world, view, way.direction, way.squared * way.inverse, light->face, wanted, traced COUNTED_ARGUMENT);
    const Vec sent = vec_scale(vec_mul(light->weight, view->weight), g);
    add_shared(base, offsets, sent, sum, g * light->density * view->density, seen & !first COUNTED_ARGUMENT);
    const lanes_mask own = seen & first;
    if (!lanes_any(own)) return;
    COUNTED_LANES(own, GBDPT_ADD_OWN_WORK)
    path->radiance = vec_select(path->radiance, vec_add_scaled(path->radiance, sent, 1.0f / sum), own);
#pragma unroll 1
    for (uint i = 0; i < NEIGHBOURS; ++i)
        join_first(world, &offsets[i], &gradients->toward[i], light, sent, sum, own, traced COUNTED_ARGUMENT);
}

/* A point of a lamp, as a vertex of the camera's path asked for it. */
typedef struct Asked {
    Vec position, radiance;
    lanes_f area_density;
    lanes_f per_area; /* density of asking for it from there, by solid angle, times the lamp's cosine over the squared distance */
    Lamp lamp;
    lanes_u face;
} Asked;

ALWAYS_INLINE void ask_first(const World* world, Offset* offset, Vec* toward, const Asked* asked, Vec own, lanes_f sum,
                             lanes_mask counts, Traced* traced COUNTED_PARAMETER) {
    const Vec nothing = vec_of((float4)(0.0f));
    if (!lanes_any(counts & offset->follows)) {
        add_difference(toward, own, sum, nothing, (lanes_f)(0.0f), counts COUNTED_ARGUMENT);
        return;
    }
    COUNTED_LANES(counts & offset->follows, GBDPT_ASK_WAY_WORK)
    const Vertex first = first_vertex(offset), *view = &first;
    Ray ray;
    const Vec way = vec_sub(asked->position, view->position);
    const lanes_f squared = vec_dot(way, way), inverse = lanes_rsqrt(squared), distance = squared * inverse;
    ray.origin = view->position;
    ray.direction = vec_scale(way, inverse);
    const lanes_f cosine = vec_dot(view->normal, ray.direction);
    const lanes_f of_lamp = vec_dot(ray.direction, vec_sub(asked->lamp.centre, asked->position));
    const lanes_mask wanted = counts & offset->follows & (cosine > 0.0f) & (of_lamp > 0.0f);
    lanes_mask seen = lanes_none();
    if (lanes_any(wanted))
        seen = sees_from(world, view, ray.direction, distance, asked->face, wanted, traced COUNTED_ARGUMENT);
    if (!lanes_any(seen)) {
        add_difference(toward, own, sum, nothing, (lanes_f)(0.0f), counts COUNTED_ARGUMENT);
        return;
    }
    COUNTED_LANES(seen, GBDPT_ASK_WORK)
    const Density density = density_of_way(&asked->lamp, &ray, distance, seen COUNTED_ARGUMENT);
    const lanes_f ratio = offset->likelihood * of_lamp * inverse * inverse / asked->per_area;
    const lanes_f others = view->density + asked->area_density * (1.0f / PI) * view->odds;
    const lanes_f other_sum = ratio * (density.part / (density.whole + 1e-30f) + cosine * others);
    const Vec other = vec_scale(vec_mul(asked->radiance, view->weight), ratio * cosine);
    add_difference(toward, own, sum, vec_select(nothing, other, seen), lanes_select((lanes_f)(0.0f), other_sum, seen),
                   counts COUNTED_ARGUMENT);
}

/* Adds the light of a lamp that a vertex of the camera's path asks for it. */
ALWAYS_INLINE void ask_shifted(const World* world, Path* path, const Vertex* view, Base* base, Offset* offsets, Gradients* gradients,
                               lanes_mask first, Traced* traced COUNTED_PARAMETER) {
    const LampDraw draw = draw_lamp(&path->random);
    if (!lanes_any(view->joins)) return;
    const LampSample lamp = sample_lamp(world->scene, &world->lamps, view->position, &draw, view->joins COUNTED_ARGUMENT);
    const lanes_f cosine = vec_dot(view->normal, lamp.direction);
    COUNTED_LANES(view->joins, BDPT_COSINE_WORK)
    const lanes_mask wanted = view->joins & (cosine > 0.0f) & (lamp.density.whole > 0.0f);
    if (!lanes_any(wanted)) return;
    COUNTED_LANES(wanted, GBDPT_OWN_ASK_WORK)
    const lanes_f inverse = lamp.density.whole / lamp.density.part, whole = cosine * inverse;
    const lanes_f sum = 1.0f + whole * (view->density + lamp.area_density * (1.0f / PI) * view->odds);
    const lanes_mask seen =
        sees_from(world, view, lamp.direction, lamp.distance, lamp.face, wanted, traced COUNTED_ARGUMENT);
    const Vec sent = vec_scale(vec_mul(lamp.radiance, view->weight), whole);
    add_shared(base, offsets, sent, sum, whole * lamp.area_density * (1.0f / PI) * view->density, seen & !first COUNTED_ARGUMENT);
    const lanes_mask own = seen & first;
    if (!lanes_any(own)) return;
    COUNTED_LANES(own, GBDPT_ADD_OWN_WORK)
    COUNTED_LANES(own, GBDPT_ASKED_WORK)
    path->radiance = vec_select(path->radiance, vec_add_scaled(path->radiance, sent, 1.0f / sum), own);
    Asked asked;
    lanes_u number;
    (void)lamp_met(world, lamp.face, &number);
    asked.lamp = lamp_of(&world->lamps, number);
    asked.position = vec_add_scaled(view->position, lamp.direction, lamp.distance);
    asked.radiance = lamp.radiance;
    asked.area_density = lamp.area_density;
    asked.face = lamp.face;
    const lanes_f of_lamp = vec_dot(lamp.direction, vec_sub(asked.lamp.centre, asked.position));
    asked.per_area = of_lamp / (lamp.distance * lamp.distance * inverse);
#pragma unroll 1
    for (uint i = 0; i < NEIGHBOURS; ++i)
        ask_first(world, &offsets[i], &gradients->toward[i], &asked, sent, sum, own, traced COUNTED_ARGUMENT);
}

#endif
