/* Vertices of a light path that are shown to the camera, and what they are in neighbouring pixels. */
#ifndef PTB_GBDPT_SHOW_H
#define PTB_GBDPT_SHOW_H

#include "gbdpt/offset.h"

/* Where a light path starts. */
typedef struct LampStart {
    Vec position, throughput;
    lanes_f earlier; /* see Odds */
    lanes_u number;
    Sides inside;
} LampStart;

/* The vertex of a light path before one that is shown to the camera. */
typedef struct Previous {
    Vec position, normal; /* the normal of any length */
    Vec throughput;       /* of light that leaves it */
    lanes_f last;         /* odds of the way from there are this over the geometry, */
    lanes_f earlier;      /* see Odds */
    Sides inside;
    lanes_u face, number; /* of the lamp, */
    bool on_lamp;         /* where it is there */
    lanes_mask joins;
} Previous;

ALWAYS_INLINE Previous previous_on_lamp(const World* world, const LampStart* start) {
    const Lamp lamp = lamp_of(&world->lamps, start->number);
    Previous previous;
    previous.position = start->position;
    previous.normal = vec_sub(start->position, lamp.centre);
    previous.throughput = start->throughput;
    previous.last = (lanes_f)(0.0f);
    previous.earlier = start->earlier;
    previous.inside = start->inside;
    previous.face = lamp.face;
    previous.number = start->number;
    previous.on_lamp = true;
    previous.joins = lanes_all();
    return previous;
}

ALWAYS_INLINE Previous previous_vertex(const Vertex* vertex) {
    const lanes_f inverse = 1.0f / lanes_max(vertex->density, (lanes_f)(1e-20f));
    Previous previous;
    previous.position = vertex->position;
    previous.normal = vertex->normal;
    previous.throughput = vec_scale(vertex->weight, inverse);
    previous.last = inverse;
    previous.earlier = vertex->odds * inverse;
    previous.inside = vertex->inside;
    previous.face = vertex->face;
    previous.number = (lanes_u)(0u);
    previous.on_lamp = false;
    previous.joins = vertex->joins;
    return previous;
}

/* What a vertex that the camera sees in a neighbouring pixel sends there of the light that left the previous one. */
ALWAYS_INLINE void show_offset(const World* world, const Picture* picture, lanes_u place, uint neighbour,
                               const Previous* previous, const Path* camera, lanes_f cosine_of_base, Vec own, lanes_f sum, lanes_f shown,
                               lanes_f geometry, lanes_mask counts, Traced* traced COUNTED_PARAMETER) {
    COUNTED_LANES(counts, ENGINE_NEIGHBOUR_WORK(neighbour))
    const lanes_mask there = counts & has_neighbour(picture, place, neighbour);
    if (!lanes_any(there)) return;
    Path shifted;
    shifted.ray = camera->ray;
    shifted.inside = camera->inside;
    shifted.throughput = vec_of((float4)(1.0f));
    shifted.ray.direction = shifted_direction(picture, camera->ray.direction, cosine_of_base, neighbour, there COUNTED_ARGUMENT);
    COUNTED_MEETING(world->scene, there)
    COUNTED_LANES(there, GBDPT_VIEW_WORK)
    const lanes_f from_axis = vec_dot(shifted.ray.direction, vec_of(picture->frame.axis_area));
    const Arrival met = meet(world, &shifted COUNTED_ARGUMENT);
    traced->light_segments += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), there);
    const lanes_f away = hit_distance(&met.hit);
    const Vec to_camera = vec_scale(shifted.ray.direction, (lanes_f)(-1.0f));
    const Vertex view = move_there(&shifted, &met, there);
    const Way way = way_to(&view, previous->position, previous->normal);
    const lanes_mask wanted = there & met.matte & previous->joins & way_faces(&way, &view.inside, &previous->inside);
    Vec other = vec_of((float4)(0.0f));
    lanes_f other_sum = (lanes_f)(0.0f);
    if (lanes_any(wanted)) {
        const lanes_f distance = way.squared * way.inverse;
        const lanes_mask seen =
            sees_from(world, &view, way.direction, distance, previous->face, wanted, traced COUNTED_ARGUMENT);
        COUNTED_LANES(wanted, GBDPT_VIEW_WEIGHT_WORK)
        const lanes_f g = way_geometry(&way), ratio = g / geometry;
        /* the geometry of the way to the camera, over the density of its direction in the picture */
        const lanes_f g_camera = vec_dot(view.normal, to_camera) / (away * away * inverse_of_picture(picture, from_axis));
        lanes_f last;
        if (previous->on_lamp) {
            COUNTED_LANES(wanted, GBDPT_VIEW_LAMP_WORK)
            const Lamp lamp = lamp_of(&world->lamps, previous->number);
            Ray back;
            back.origin = view.position;
            back.direction = way.direction;
            const Density density = density_of_way(&lamp, &back, distance, wanted COUNTED_ARGUMENT);
            last = previous->earlier * density.part / (density.whole * way.cosine);
        } else {
            COUNTED_LANES(wanted, GBDPT_VIEW_VERTEX_WORK)
            last = previous->last / g;
        }
        const lanes_f odds = last + previous->earlier * met.goes_on * (1.0f / PI);
        other = vec_select(other, vec_scale(vec_mul(previous->throughput, view.weight), ratio * shown), seen);
        other_sum = lanes_select(other_sum, ratio * shown * (1.0f / g_camera + odds), seen);
    }
    Vec more = vec_of((float4)(0.0f));
    add_difference(&more, own, sum, other, other_sum, there COUNTED_ARGUMENT);
    add_gradient(picture, neighbour, place, more, squared_mean(more), there COUNTED_ARGUMENT);
}

/* Adds what a vertex of the light path sends to the camera itself, where the picture shows it; see bdpt/join.h. */
ALWAYS_INLINE void show_shifted(const World* world, const Picture* picture, lanes_u half_of_samples, const Vertex* light,
                                const Previous* previous, const Sides* of_camera, Traced* traced COUNTED_PARAMETER) {
    const WayToCamera way = way_to_camera(picture, light, of_camera COUNTED_ARGUMENT);
    if (!lanes_any(way.wanted)) return;
    COUNTED_LANES(way.wanted, GBDPT_SHOW_WORK)
    const lanes_f g = way.of_light * way.inverse * way.inverse;
    const lanes_f shown = g / inverse_of_picture(picture, way.cosine);
    const lanes_f sum = 1.0f + shown * light->odds;
    const lanes_mask seen =
        sees_from(world, light, way.direction, way.squared * way.inverse, (lanes_u)(SEES_POINT), way.wanted, traced COUNTED_ARGUMENT);
    if (!lanes_any(seen)) return;
    COUNTED_LANES(seen, GBDPT_SHOWN_WORK)
    COUNTED_LANES(seen, GBDPT_GEOMETRY_WORK)
    const Vec own = vec_scale(light->weight, shown), added = vec_scale(own, 1.0f / sum);
    const lanes_u place = way.pixel + half_of_samples;
    add_to_gradients(picture, 0u, place, added, squared_mean(added), seen COUNTED_ARGUMENT);

    Path camera;
    camera.ray.origin = vec_of(picture->camera);
    camera.ray.direction = way.from_camera;
    camera.inside = *of_camera;
    const Vec back = vec_sub(previous->position, light->position);
    const lanes_f back_squared = vec_dot(back, back), back_inverse = lanes_rsqrt(back_squared);
    const lanes_f base_geometry = -vec_dot(light->normal, back) * vec_dot(previous->normal, back) * back_inverse * back_inverse *
                                  back_inverse * back_inverse;
#pragma unroll 1
    for (uint i = 0; i < NEIGHBOURS; ++i)
        show_offset(world, picture, place, i, previous, &camera, way.cosine, own, sum, shown, base_geometry, seen,
                    traced COUNTED_ARGUMENT);
}

#endif
