/* Three lanes-wide numbers: points, directions, colours. */
#ifndef PTB_LIB_VEC_H
#define PTB_LIB_VEC_H

#include "lib/roots.h"

typedef struct Vec {
    lanes_f x, y, z;
} Vec;

static inline Vec vec(lanes_f x, lanes_f y, lanes_f z) {
    Vec v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
static inline Vec vec_of(float4 v) { return vec((lanes_f)(v.x), (lanes_f)(v.y), (lanes_f)(v.z)); }
static inline Vec vec_add(Vec a, Vec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Vec vec_sub(Vec a, Vec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Vec vec_scale(Vec a, lanes_f s) { return vec(a.x * s, a.y * s, a.z * s); }
static inline Vec vec_mul(Vec a, Vec b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }
/* a + b s */
static inline Vec vec_add_scaled(Vec a, Vec b, lanes_f s) {
    return vec(b.x * s + a.x, b.y * s + a.y, b.z * s + a.z);
}
/* a + b c, component by component */
static inline Vec vec_mul_add(Vec a, Vec b, Vec c) { return vec(b.x * c.x + a.x, b.y * c.y + a.y, b.z * c.z + a.z); }
static inline lanes_f vec_dot(Vec a, Vec b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
static inline Vec vec_normalize(Vec a) { return vec_scale(a, lanes_rsqrt(vec_dot(a, a))); }
static inline Vec vec_select(Vec if_false, Vec if_true, lanes_mask mask) {
    return vec(lanes_select(if_false.x, if_true.x, mask), lanes_select(if_false.y, if_true.y, mask),
               lanes_select(if_false.z, if_true.z, mask));
}

#endif
