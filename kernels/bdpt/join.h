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

/* The straight way from a vertex to a point of light, by its cosines at both. */
typedef struct Way {
    Vec direction;
    lanes_f squared, inverse; /* of its length */
    lanes_f cosine, of_light;
} Way;

ALWAYS_INLINE Way way_to(const Vertex* vertex, Vec point, Vec normal) {
    const Vec between = vec_sub(point, vertex->position);
    Way way;
    way.squared = vec_dot(between, between);
    way.inverse = lanes_rsqrt(way.squared);
    way.direction = vec_scale(between, way.inverse);
    way.cosine = vec_dot(vertex->normal, way.direction);
    way.of_light = -vec_dot(normal, way.direction);
    return way;
}

/* The lanes where both ends face each other, on the same side of all surfaces. */
static inline lanes_mask way_faces(const Way* way, const Sides* inside, const Sides* of_light) {
    return (way->cosine > 0.0f) & (way->of_light > 0.0f) & !sides_differ(inside, of_light);
}

/* The cosines over the squared distance. */
static inline lanes_f way_geometry(const Way* way) { return way->cosine * way->of_light * way->inverse * way->inverse; }

/* Adds what a vertex of the light path sends by way of one of the camera's. With the geometry g, the cosines over the squared
   distance, the sum is worth g and weighs 1 / (1 + g k), k being the odds of all other strategies. */
ALWAYS_INLINE void join(const World* world, Path* path, const Vertex* view, const Vertex* light, Traced* traced COUNTED_PARAMETER) {
    const lanes_mask joins = view->joins & light->joins;
    if (!lanes_any(joins)) return;
    const Way way = way_to(view, light->position, light->normal);
    COUNTED_LANES(joins, BDPT_WAY_WORK)
    const lanes_mask wanted = joins & way_faces(&way, &view->inside, &light->inside);
    if (!lanes_any(wanted)) return;
    COUNTED_LANES(wanted, BDPT_JOIN_WORK)
    const lanes_f g = way_geometry(&way);
    const lanes_f share = g / (1.0f + g * (view->density * light->odds + light->density * view->odds));
    const lanes_mask seen =
        sees_from(world, view, way.direction, way.squared * way.inverse, light->face, wanted, traced COUNTED_ARGUMENT);
    const Vec sent = vec_mul(light->weight, view->weight);
    path->radiance = vec_select(path->radiance, vec_add_scaled(path->radiance, sent, share), seen);
}

/* The straight way from a vertex of a light path to the camera. */
typedef struct WayToCamera {
    Vec direction, from_camera;
    lanes_f squared, inverse; /* of its length */
    lanes_f cosine, of_light; /* at the camera and at the vertex */
    lanes_u pixel;
    lanes_mask wanted; /* where the picture shows it */
} WayToCamera;

ALWAYS_INLINE WayToCamera way_to_camera(const Picture* picture, const Vertex* light, const Sides* of_camera COUNTED_PARAMETER) {
    const Vec between = vec_sub(vec_of(picture->camera), light->position);
    WayToCamera way;
    way.squared = vec_dot(between, between);
    way.inverse = lanes_rsqrt(way.squared);
    way.direction = vec_scale(between, way.inverse);
    way.from_camera = vec_scale(way.direction, (lanes_f)(-1.0f));
    way.of_light = vec_dot(light->normal, way.direction);
    way.cosine = vec_dot(way.from_camera, vec_of(picture->frame.axis_area));
    COUNTED_LANES(light->joins, BDPT_PIXEL_WORK)
    const lanes_mask within = pixel_of(picture, way.from_camera, way.cosine, &way.pixel);
    way.wanted = light->joins & within & (way.of_light > 0.0f) & !sides_differ(&light->inside, of_camera);
    return way;
}

/* Adds what a vertex of the light path sends to the camera itself, where the picture shows it. */
ALWAYS_INLINE void show(const World* world, const Picture* picture, const Vertex* light, const Sides* of_camera,
                        Traced* traced COUNTED_PARAMETER) {
    if (!lanes_any(light->joins)) return;
    const WayToCamera way = way_to_camera(picture, light, of_camera COUNTED_ARGUMENT);
    if (!lanes_any(way.wanted)) return;
    COUNTED_LANES(way.wanted, BDPT_SHOW_WORK)
    const lanes_f g = way.of_light * way.inverse * way.inverse;
    const lanes_f share = g / (inverse_of_picture(picture, way.cosine) + g * light->odds);
    const lanes_mask seen = sees_from(world, light, way.direction, way.squared * way.inverse, (lanes_u)(SEES_POINT),
                                      way.wanted, traced COUNTED_ARGUMENT);
    splat(picture, way.pixel, vec_scale(light->weight, share), seen COUNTED_ARGUMENT);
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
