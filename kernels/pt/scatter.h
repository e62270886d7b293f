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

/* Decides by `u` between reflection and transmission with the exact Fresnel reflectance for unpolarised light;
   `cosine` is the incident one, eta the ratio of indices, here over beyond. Where `dielectric`, rewrites the mix; returns
   the lanes that went through. */
static inline lanes_mask refract_some(Mix* mix, lanes_f cosine, lanes_f eta, lanes_f u, lanes_mask dielectric) {
    const lanes_f cos_t_squared = 1.0f - eta * eta * (1.0f - cosine * cosine);
    const lanes_f cos_t = native_sqrt(fmax(cos_t_squared, (lanes_f)(0.0f)));
    const lanes_f s_minus = eta * cosine - cos_t, s_plus = eta * cosine + cos_t;
    const lanes_f p_minus = cosine - eta * cos_t, p_plus = cosine + eta * cos_t;
    /* reflectance = ((s-/s+)^2 + (p-/p+)^2) / 2, compared with u without dividing; total reflection has s+ = s- */
    const lanes_f s = s_minus * p_plus, p = p_minus * s_plus, both = s_plus * p_plus;
    const lanes_mask through = dielectric & (cos_t_squared > 0.0f) & (2.0f * u * both * both >= s * s + p * p);
    mix->along = lanes_select(mix->along, eta, through);
    mix->normal = lanes_select(mix->normal, s_minus, through);
    return through;
}

/* Moves the rays to their hits and gives them new directions; where they pass through a dielectric, changes sides. */
static inline void scatter(Ray* ray, Sides* inside, Hit hit, const Surface* surface, Random* random) {
    const lanes_f u = random_next(random);
    const lanes_f v = random_next(random);
    ray->origin = vec_add_scaled(ray->origin, ray->direction, hit.distance);
    const Vec normal = vec_scale(vec_sub(ray->origin, surface->centre), surface->inverse_radius * hit.facing);
    const lanes_f cosine = fmin(fmax(-vec_dot(ray->direction, normal), (lanes_f)(0.0f)), (lanes_f)(1.0f));
    Mix mix;
    mix.along = 1.0f - surface->matte;
    mix.normal = lanes_select(2.0f * cosine, (lanes_f)(1.0f), surface->matte > 0.0f);
    mix.sphere = surface->matte;
    const lanes_mask dielectric = surface->ior > 0.0f;
    if (lanes_any(dielectric)) {
        const lanes_f eta = lanes_select(1.0f / surface->ior, surface->ior, hit.facing < 0.0f);
        const lanes_mask through = refract_some(&mix, cosine, eta, u, dielectric);
        change_sides(inside, surface->side, through);
    }
    const Vec point = uniform_sphere(u, v);
    ray->direction =
        vec_normalize(vec_add_scaled(vec_add_scaled(vec_scale(ray->direction, mix.along), normal, mix.normal), point,
                                     mix.sphere));
}

#endif
