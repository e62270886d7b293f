/* One bounce. */
#ifndef PTB_SCENE_SCATTER_H
#define PTB_SCENE_SCATTER_H

#include "lib/sphere_direction.h"
#include "scene/surface.h"

/* What is random in a bounce: a uniform point of the unit sphere. A dielectric makes two other numbers of it. */
static inline Vec draw_bounce(Random* random) {
    lanes_u u, v;
    random_next_two(random, &u, &v);
    return uniform_sphere(u, v);
}

/* A new direction is base + normal * n, then normalised; n is the normal towards the old direction d.
   Matte:     s + n, s a uniform point of the unit sphere: cosine-weighted, see "Ray Tracing in One Weekend", by P. Shirley.
   Mirror:    d + 2 cos n.
   Refracted: d + (cos - cos_t / eta) n.
   Normals are not scaled to length 1: n = outwards * from_centre, and so cos = -outwards * along.

   Decides between reflection and transmission with the exact Fresnel reflectance for unpolarised light. That is polarised
   either way with the same probability, so one random bit, the sign of y, picks the way, and one quotient is asked for
   instead of two; |z| is uniform in [0, 1]. `normal` is from_centre's share in the mirrored direction; rewrites that of
   the lanes that go through and returns them. */
static inline lanes_mask refract_some(lanes_f* normal, lanes_f along, const Surface* surface, const Vec* draw) {
    const lanes_f eta_cos = -along * surface->before;
    /* NaN, so no transmission, where reflection is total */
    const lanes_f cos_t = lanes_sqrt(eta_cos * eta_cos + surface->less_eta_squared);
    /* eta cos -+ cos_t, or eta (cos -+ eta cos_t) of parallel polarisation; of these only the ratio matters */
    const lanes_f factor = lanes_select((lanes_f)(1.0f), surface->eta_squared, lanes_as_i(draw->y) < 0);
    const lanes_f minus = eta_cos - factor * cos_t, plus = eta_cos + factor * cos_t;
    /* reflectance = (minus / plus)^2, compared with |z| without dividing */
    const lanes_mask through = lanes_abs(draw->z) * (plus * plus) >= minus * minus;
    *normal = lanes_select(*normal, 0.5f * *normal - cos_t * surface->beyond, through);
    return through;
}

/* Turns a ray into the direction of a sum; returns 1 / its length. */
ALWAYS_INLINE lanes_f turn_along(Ray* ray, Vec sum, Vec outwards, lanes_f normal) {
    const lanes_f squared_length = vec_dot(sum, sum);
#ifdef SCENE_TREE
    /* the point drawn may be the very opposite of a flat surface's normal, along an axis once in 50 million times */
    if (squared_length == 0.0f) {
        ray->direction = vec_scale(outwards, normal);
        return 0.5f;
    }
#else
    (void)outwards, (void)normal;
#endif
    const lanes_f inverse_length = lanes_rsqrt(squared_length);
    ray->direction = vec_scale(sum, inverse_length);
    return inverse_length;
}

/* Gives rays that are at their hits new directions; where they pass through a dielectric, changes sides. Returns 1 / length
   of the sum that the direction is made of: of a matte surface 1 / twice its cosine. */
ALWAYS_INLINE lanes_f scatter(Scene scene, Ray* ray, Sides* inside, const Hit* hit, const Surface* surface,
                              const Vec* draw COUNTED_PARAMETER) {
    const Vec outwards = from_centre(ray, surface->centre);
    const lanes_f along = vec_dot(ray->direction, outwards);
    lanes_f normal = surface->matte - surface->mirrored * along;
    const Vec base = vec_select(*draw, ray->direction, surface->mirrored > 0.0f);
    /* of many rays some is mostly at a dielectric, so there is no branch */
    if (scene_refracts(scene))
        pass_through(scene, ray, inside, hit, along, refract_some(&normal, along, surface, draw) COUNTED_ARGUMENT);
    return turn_along(ray, vec_add_scaled(base, outwards, normal), outwards, normal);
}

#endif
