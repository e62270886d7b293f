/* One bounce. */
#ifndef PTB_PT_SCATTER_H
#define PTB_PT_SCATTER_H

#include "lib/random.h"
#include "lib/sphere_direction.h"
#include "pt/surface.h"

/* A new direction is along * d + normal * n + sphere * s, then normalised: d the old one, n the normal towards it, s
   a uniform point of the unit sphere.
   Matte:    n + s, which is cosine-weighted: see "Ray Tracing in One Weekend", by P. Shirley.
   Mirror:   d + 2 cos n.
   Refracted: eta d + (eta cos - cos_t) n. */
typedef struct Mix {
    lanes_f along, normal, sphere;
} Mix;

/* Decides by `u`, in [1, 2), between reflection and transmission with the exact Fresnel reflectance for unpolarised
   light; `cosine` is the incident one, eta the ratio of indices, here over beyond, or NaN. Rewrites the mix of the lanes
   that go through and returns them. */
static inline lanes_mask refract_some(Mix* mix, lanes_f cosine, lanes_f eta, lanes_f u) {
    const lanes_f cos_t_squared = 1.0f - eta * eta * (1.0f - cosine * cosine);
    const lanes_f cos_t = lanes_sqrt(cos_t_squared); /* NaN, so no transmission, where reflection is total */
    const lanes_f eta_cosine = eta * cosine;
    const lanes_f s_minus = eta_cosine - cos_t, s_plus = eta_cosine + cos_t;
    const lanes_f p_minus = cosine - eta * cos_t, p_plus = cosine + eta * cos_t;
    /* reflectance = ((s-/s+)^2 + (p-/p+)^2) / 2, compared with u - 1 without dividing */
    const lanes_f s = s_minus * p_plus, p = p_minus * s_plus, both = s_plus * p_plus;
    const lanes_mask through = (2.0f * u - 2.0f) * both * both >= s * s + p * p;
    mix->along = lanes_select(mix->along, eta, through);
    mix->normal = lanes_select(mix->normal, s_minus, through);
    return through;
}

/* Moves the rays to their hits and gives them new directions; where they pass through a dielectric, changes sides. */
static inline void scatter(Ray* ray, Sides* inside, const Hit* hit, const Surface* surface, Random* random) {
    lanes_f u, v;
    random_next_two(random, &u, &v);
    const lanes_mask from_inside = is_inside_own(inside, surface->side);
    move_to_hit(ray, hit);
    const lanes_f outwards = lanes_select(surface->inverse_radius, -surface->inverse_radius, from_inside);
    const Vec normal = vec_scale(vec_sub(ray->origin, surface->centre), outwards);
    const lanes_f cosine = -vec_dot(ray->direction, normal);
    Mix mix;
    mix.along = surface->keeps;
    mix.sphere = surface->matte;
    mix.normal = 2.0f * cosine * surface->keeps + surface->matte;
    const lanes_f eta = lanes_select(surface->inverse_ior, surface->ior, from_inside);
    if (PTB_LANES > 1 || lanes_any(eta > 0.0f)) { /* of many rays some is mostly at a dielectric */
        const lanes_mask through = refract_some(&mix, cosine, eta, u);
        change_sides(inside, surface->side, through);
    }
    ray->direction = vec_normalize(vec_add_scaled(
        vec_add_scaled(vec_scale(ray->direction, mix.along), normal, mix.normal), uniform_sphere(u, v), mix.sphere));
}

#endif
