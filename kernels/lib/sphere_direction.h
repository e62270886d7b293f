/* Uniform directions. */
#ifndef PTB_LIB_SPHERE_DIRECTION_H
#define PTB_LIB_SPHERE_DIRECTION_H

#include "lib/vec.h"

/* Sine and cosine of 2 pi (turns - 1/2), turns in [0, 1): half-angle polynomials (minimax, error below 2e-6), since
   the built-in sin and cos of vectors leave SIMD on CPUs. */
static inline void half_turned_sincos(lanes_f turns, lanes_f* sine, lanes_f* cosine) {
    const lanes_f x = turns - 0.5f;
    const lanes_f xx = x * x;
    const lanes_f s = x * (((-0.5546364588f * xx + 2.541899150f) * xx - 5.167142813f) * xx + 3.141582023f);
    const lanes_f c =
        (((0.2196981904f * xx - 1.331880942f) * xx + 4.058412060f) * xx - 4.934792869f) * xx + 0.9999999537f;
    *sine = 2.0f * s * c;
    *cosine = 1.0f - 2.0f * s * s;
}

/* A point of the unit sphere, uniform by area, of two uniform numbers (Archimedes: z is uniform). */
static inline Vec uniform_sphere(lanes_f u, lanes_f v) {
    lanes_f sine, cosine;
    half_turned_sincos(v, &sine, &cosine);
    const lanes_f radius = 2.0f * native_sqrt(u * (1.0f - u));
    return vec(radius * cosine, radius * sine, 1.0f - 2.0f * u);
}

#endif
