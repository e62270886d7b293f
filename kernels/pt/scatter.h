/* One bounce. */
#ifndef PTB_PT_SCATTER_H
#define PTB_PT_SCATTER_H

#include "lib/random.h"
#include "lib/sphere_direction.h"
#include "pt/surface.h"

/* The random numbers of a bounce. */
typedef struct Draw {
    lanes_f choice; /* between reflection and transmission, in [1, 2) */
    Vec sphere;     /* a uniform point of the unit sphere */
} Draw;

static inline Draw draw_bounce(Random* random) {
    lanes_f u, v;
    random_next_two(random, &u, &v);
    Draw draw;
    draw.choice = u;
    draw.sphere = uniform_sphere(u, v);
    return draw;
}

/* With AVX2, where registers are few and what waits for a hit fills the scheduler, drawing before the intersection pays:
   1.06 (two Zen 3 cores, PoCL); with AVX-512 it costs 0.95. */
#define PT_DRAWS_EARLY (PTB_X86 == 8)

static inline Draw hold_draw(Draw draw) {
    draw.sphere.x = lanes_as_f(lanes_hold(lanes_as_i(draw.sphere.x)));
    draw.sphere.y = lanes_as_f(lanes_hold(lanes_as_i(draw.sphere.y)));
    draw.sphere.z = lanes_as_f(lanes_hold(lanes_as_i(draw.sphere.z)));
    return draw;
}

/* A new direction is base + normal * n, then normalised; n is the normal towards the old direction d.
   Matte:     s + n, s a uniform point of the unit sphere: cosine-weighted, see "Ray Tracing in One Weekend", by P. Shirley.
   Mirror:    d + 2 cos n.
   Refracted: d + (cos - cos_t / eta) n.

   Decides between reflection and transmission with the exact Fresnel reflectance for unpolarised light; `cosine` is the
   incident one, eta the ratio of indices, here over beyond, or NaN. Unpolarised light is polarised either way with the
   same probability, so one random bit, the last of `u`, picks the way, and one quotient is asked for instead of two.
   Rewrites the normal's share of the lanes that go through and returns them. */
static inline lanes_mask refract_some(lanes_f* normal, lanes_f outwards, lanes_f cosine, lanes_f eta, lanes_f inverse_eta,
                                      lanes_f u) {
    /* NaN, so no transmission, where reflection is total */
    const lanes_f cos_t = lanes_sqrt(1.0f - eta * eta * (1.0f - cosine * cosine));
    const lanes_mask parallel = lanes_as_i(lanes_as_u(u) << 31) < 0;
    const lanes_f incident = lanes_select(eta * cosine, cosine, parallel);
    const lanes_f refracted = lanes_select(cos_t, eta * cos_t, parallel);
    const lanes_f minus = incident - refracted, plus = incident + refracted;
    /* reflectance = (minus / plus)^2, compared with u - 1 without dividing */
    const lanes_mask through = (u - 1.0f) * (plus * plus) >= minus * minus;
    *normal = lanes_select(*normal, outwards * cosine - cos_t * (outwards * inverse_eta), through);
    return through;
}

/* Moves the rays to their hits and gives them new directions; where they pass through a dielectric, changes sides. */
static inline void scatter(Ray* ray, Sides* inside, const Hit* hit, const Surface* surface, const Draw* draw) {
    const lanes_mask from_inside = is_inside_own(inside, surface->side);
    move_to_hit(ray, hit);
    /* The normal is outwards * from_centre; two products fewer than by its own length. */
    const lanes_f outwards = lanes_select(surface->inverse_radius, -surface->inverse_radius, from_inside);
    const Vec from_centre = vec_sub(ray->origin, surface->centre);
    const lanes_f cosine = -vec_dot(ray->direction, from_centre) * outwards;
    const lanes_mask keeps = surface->kind > 0.0f;
    const Vec base = vec_select(draw->sphere, ray->direction, keeps);
    const lanes_f away = outwards * cosine;
    lanes_f normal = lanes_select(outwards, away + away, keeps);
    if (PTB_LANES > 1 || lanes_any(surface->ior > 0.0f)) { /* of many rays some is mostly at a dielectric */
        const lanes_f eta = lanes_select(surface->inverse_ior, surface->ior, from_inside);
        const lanes_f inverse_eta = lanes_select(surface->ior, surface->inverse_ior, from_inside);
        const lanes_mask through = refract_some(&normal, outwards, cosine, eta, inverse_eta, draw->choice);
        change_sides(inside, surface->side, through);
    }
    ray->direction = vec_normalize(vec_add_scaled(base, from_centre, normal));
}

#endif
