/* Uniform directions. */
#ifndef PTB_LIB_SPHERE_DIRECTION_H
#define PTB_LIB_SPHERE_DIRECTION_H

#include "lib/random.h"
#include "lib/vec.h"

/* Sine and cosine of 2 pi turns, times `length`, for turns in [1, 2). */
static inline void turned_sincos(lanes_f turns, lanes_f length, lanes_f* sine, lanes_f* cosine) {
#if PTB_PTX
    *sine = length * native_sin(6.283185307f * turns);
    *cosine = length * native_cos(6.283185307f * turns);
#else
    /* Half-angle polynomials (minimax, error below 2e-6): the built-in sin and cos of vectors leave SIMD on CPUs. */
    const lanes_f x = turns - 1.5f;
    const lanes_f xx = x * x;
    const lanes_f s = x * (((-0.5546364588f * xx + 2.541899150f) * xx - 5.167142813f) * xx + 3.141582023f);
    const lanes_f c =
        (((0.2196981904f * xx - 1.331880942f) * xx + 4.058412060f) * xx - 4.934792869f) * xx + 0.9999999537f;
    const lanes_f twice = (length + length) * s;
    *sine = twice * c;
    *cosine = length - twice * s;
#endif
}

/* A point of the unit sphere, uniform by area, of two random words (Archimedes: z is uniform). The sign of y does not
   depend on z. */
static inline Vec uniform_sphere(lanes_u u, lanes_u v) {
    Vec point;
    point.z = 3.0f - random_2_4(u); /* exact, so never beyond 1 */
    turned_sincos(random_1_2(v), lanes_sqrt(1.0f - point.z * point.z), &point.y, &point.x);
    return point;
}

#endif
