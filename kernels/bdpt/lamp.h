/* The first vertex of a light path, which lies on a lamp. */
#ifndef PTB_BDPT_LAMP_H
#define PTB_BDPT_LAMP_H

#include "bdpt/vertex.h"

/* Puts paths on the sides of a point: those of the camera, but for dielectrics, which may hold a lamp. */
ALWAYS_INLINE void start_inside(const World* world, const Sides* of_camera, Vec point, Sides* inside) {
    const Scene scene = world->scene;
    *inside = *of_camera;
    for (uint i = 0; i < two_sided_spheres(scene); ++i) {
        const lanes_u outer = (lanes_u)(2u * i);
        const Surface surface = surface_of(&world->surfaces, outer);
        const Vec from_centre = vec_sub(point, surface.centre);
        const lanes_mask is_glass = surface.eta_squared == surface.eta_squared;
        /* of a dielectric `mirrored` is 2 / radius^2 */
        const lanes_mask within = surface.mirrored * vec_dot(from_centre, from_centre) < 2.0f;
        const lanes_mask is_within = lanes_as_i(side_sign(scene, side_of(scene, inside, i))) < 0;
        change_sides(scene, inside, outer, is_glass & ((within & !is_within) | (!within & is_within)));
    }
}

/* Starts a path at a point of a lamp, uniform by area, in a direction that is so by cosine; returns the lamp's number. */
ALWAYS_INLINE lanes_u leave_lamp(const World* world, Path* path, Odds* odds, lanes_mask alive COUNTED_PARAMETER) {
    const Sides of_camera = path->inside;
    const LampDraw draw = draw_lamp(&path->random);
    const lanes_u number = choose_lamp(&world->lamps, draw.choice, draw.share);
    const Lamp lamp = lamp_of(&world->lamps, number);
    const Vec normal = start_on_lamp(world->scene, &lamp, &draw, &path->ray, alive COUNTED_ARGUMENT);
    const Vec toward = draw_bounce(&path->random);
    COUNTED_LANES(alive, BDPT_START_WORK(two_sided_spheres(world->scene)))
    turn_along(&path->ray, vec_add_scaled(toward, normal, (lanes_f)(1.0f)), normal, (lanes_f)(1.0f));
    odds->last = (lanes_f)(0.0f); /* see odds_of_asking */
    odds->earlier = PI / area_density_of(&lamp);
    path->throughput = vec_scale(lamp.radiance, odds->earlier);
    start_inside(world, &of_camera, path->ray.origin, &path->inside);
    return number;
}

/* What move_to_vertex has to know of the first surface that a light path meets: asking the lamp from there is the strategy that
   gives the camera one vertex more. */
ALWAYS_INLINE lanes_f odds_of_asking(const World* world, const Path* path, const Arrival* met, const Odds* odds,
                                     lanes_u number, lanes_mask alive COUNTED_PARAMETER) {
    COUNTED_LANES(alive, BDPT_FIRST_WORK)
    const lanes_f distance = hit_distance(&met->hit);
    Ray back = path->ray;
    back.origin = vec_add_scaled(path->ray.origin, path->ray.direction, distance);
    back.direction = vec_scale(path->ray.direction, (lanes_f)(-1.0f));
    const Lamp lamp = lamp_of(&world->lamps, number);
    const Density density = density_of_way(&lamp, &back, distance, alive COUNTED_ARGUMENT);
    return odds->earlier * density.part / density.whole;
}

#endif
