/* The scene as `pt` sees it, and where a ray meets it. */
#ifndef PTB_PT_SCENE_H
#define PTB_PT_SCENE_H

#include "lib/vec.h"
#include "shared/pt.h"

/* Where the spheres lie: constant memory, or global memory when they are too many for it. */
#ifndef PT_SCENE_SPACE
#define PT_SCENE_SPACE __constant
#endif

/* 32-bit words that hold one side bit per two-sided sphere. */
#ifndef PT_SIDE_WORDS
#define PT_SIDE_WORDS 1
#endif

typedef struct Scene {
    PT_SCENE_SPACE const PtSphere* spheres; /* opaque ones first, then two-sided ones */
    uint opaque;
    uint two_sided;
} Scene;

/* Which two-sided spheres a path is inside: a bit each. Only transmission changes it. */
typedef struct Sides {
    lanes_u word[PT_SIDE_WORDS];
} Sides;

static inline void change_sides(Sides* inside, lanes_f two_sided, lanes_mask through) {
    const lanes_u number = lanes_as_u(lanes_to_i(two_sided));
    const lanes_u bit = (lanes_u)(1u) << (number & 31u);
    for (uint i = 0; i < PT_SIDE_WORDS; ++i) {
        inside->word[i] ^= lanes_select_u((lanes_u)(0u), bit, through & ((number >> 5) == (lanes_u)(i)));
    }
}

typedef struct Ray {
    Vec origin, direction; /* the direction has length 1 */
} Ray;

typedef struct Hit {
    lanes_f distance;  /* INFINITY: nothing met */
    lanes_u sphere;    /* 0 where nothing is met */
    lanes_f facing;    /* 1: met from outside, -1: from inside */
} Hit;

/* Half the linear and the constant coefficient of the quadratic in the distance to a sphere, from the centre and
   k = |c|^2 - r^2. This keeps large walls precise: |o - c|^2 of a wall of radius 10 000 has an ulp of 8, k + o.o - 2 o.c
   is a sum of numbers that are twenty times smaller. */
typedef struct Quadratic {
    lanes_f b, q; /* distance = b -+ sqrt(b b - q) */
} Quadratic;

static inline Quadratic quadratic_of(float4 centre_k, Vec direction, Vec minus_two_origin, lanes_f minus_od,
                                     lanes_f oo) {
    Quadratic e;
    e.b = centre_k.x * direction.x + (centre_k.y * direction.y + (centre_k.z * direction.z + minus_od));
    e.q = centre_k.x * minus_two_origin.x +
          (centre_k.y * minus_two_origin.y + (centre_k.z * minus_two_origin.z + (oo + centre_k.w)));
    return e;
}

/* The nearest sphere ahead. No epsilon: a path knows on which side of every sphere it is, whatever rounding did to
   the ray's origin. From outside, a sphere is met iff its centre lies ahead and the line meets it, at the near root,
   so a ray that leaves a sphere cannot meet it again; from inside it is always met, at the far root. */
static inline Hit nearest_hit(Scene scene, Ray ray, const Sides* inside) {
    const Vec minus_two_origin = vec_scale(ray.origin, (lanes_f)(-2.0f));
    const lanes_f minus_od = -vec_dot(ray.origin, ray.direction);
    const lanes_f oo = vec_dot(ray.origin, ray.origin);
    Hit hit;
    hit.distance = (lanes_f)(INFINITY);
    hit.sphere = (lanes_u)(0u);
    hit.facing = (lanes_f)(1.0f);
    for (uint i = 0; i < scene.opaque; ++i) {
        const Quadratic e = quadratic_of(scene.spheres[i].centre_k, ray.direction, minus_two_origin, minus_od, oo);
        const lanes_f t = e.b - native_sqrt(e.b * e.b - e.q); /* a missed sphere gives NaN, which is never less */
        const lanes_mask closer = (e.b > 0.0f) & (t < hit.distance);
        hit.distance = lanes_select(hit.distance, t, closer);
        hit.sphere = lanes_select_u(hit.sphere, (lanes_u)(i), closer);
    }
    for (uint j = 0; j < scene.two_sided; ++j) {
        const uint i = scene.opaque + j;
        const Quadratic e = quadratic_of(scene.spheres[i].centre_k, ray.direction, minus_two_origin, minus_od, oo);
        const lanes_mask is_inside = (inside->word[j / 32u] & (lanes_u)(1u << (j % 32u))) != (lanes_u)(0u);
        const lanes_f d = e.b * e.b - e.q;
        const lanes_f facing = lanes_select((lanes_f)(1.0f), (lanes_f)(-1.0f), is_inside);
        const lanes_f t = e.b - facing * native_sqrt(fmax(d, (lanes_f)(0.0f)));
        const lanes_mask closer = (is_inside | ((e.b > 0.0f) & (d >= 0.0f))) & (t < hit.distance);
        hit.distance = lanes_select(hit.distance, t, closer);
        hit.sphere = lanes_select_u(hit.sphere, (lanes_u)(i), closer);
        hit.facing = lanes_select(hit.facing, facing, closer);
    }
    return hit;
}

#endif
