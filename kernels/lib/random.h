/* Random numbers: a generator per path, seeded by a hash of (pixel, sample), so a path's numbers depend on nothing
   else. The generator is a linear congruential one whose state is a vector of two words modulo 2^32: two multiply-adds make
   two numbers, of which only the upper bits are used. Its 64 bits of state make paths that share a stretch of numbers
   unlikely. */
#ifndef PTB_LIB_RANDOM_H
#define PTB_LIB_RANDOM_H

#include "lib/lanes.h"

typedef struct Random {
    lanes_u a, b; /* Park and Miller's generator has one word; the compiler drops the other */
} Random;

static inline Random random_none(void) {
    Random random;
    random.a = random.b = (lanes_u)(0u);
    return random;
}
static inline Random random_select(Random if_false, Random if_true, lanes_mask mask) {
    Random random;
    random.a = lanes_select_u(if_false.a, if_true.a, mask);
    random.b = lanes_select_u(if_false.b, if_true.b, mask);
    return random;
}

/* A bijection of 32 bits whose every output bit depends on every input bit (xor-shift-multiply; the constants are
   those of C. Wellons' search for the least biased one). */
static inline lanes_u random_mix(lanes_u x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/* -DPTB_PARK_MILLER: see "Random Number Generators: Good Ones Are Hard to Find", by S. Park and K. Miller. */
#define PARK_MILLER_MODULUS 0x7fffffffu

/* The pair is a bijection of (pixel, sample), so no two paths of an image start alike. Pixels' numbers lie far apart, so
   the one word is distinct too in images of up to 2^27 samples. */
static inline lanes_u random_of_pixel(lanes_u pixel, uint seed) { return (pixel + seed * 0x9e3779b9u) * 0x9e3779b9u; }
static inline Random random_of_path(lanes_u of_pixel, lanes_u sample) {
    Random random;
    random.b = random_mix(sample + of_pixel);
    const lanes_u both = of_pixel ^ random.b;
    random.a = (both ^ (both >> 16)) * 0x7feb352du;
#ifdef PTB_PARK_MILLER
    random.a = lanes_max_u(lanes_min_u(random.a >> 1, (lanes_u)(PARK_MILLER_MODULUS - 1u)), (lanes_u)(1u));
    random.b = (lanes_u)(0u);
#endif
    return random;
}

/* Floats of a word's upper bits, in [1, 2) and [2, 4): no conversion, and most users need no other range. */
static inline lanes_f random_1_2(lanes_u word) { return lanes_as_f((word >> 9) | 0x3f800000u); }
static inline lanes_f random_2_4(lanes_u word) { return lanes_as_f((word >> 9) | 0x40000000u); }

#ifdef PTB_PARK_MILLER

/* 16807 a modulo 2^31 - 1, of which 46 bits of product are folded once. Like the thesis', but seeded for each path. */
static inline lanes_u park_miller(lanes_u a) {
    const lanes_u low = (a & 0xffffu) * 16807u;
    const lanes_u high = (a >> 16) * 16807u + (low >> 16);
    const lanes_u sum = (((high & 0x7fffu) << 16) | (low & 0xffffu)) + (high >> 15);
    return lanes_min_u(sum, sum - PARK_MILLER_MODULUS);
}
static inline void random_next_two(Random* random, lanes_u* u, lanes_u* v) {
    random->a = park_miller(random->a);
    *u = random->a << 1;
    random->a = park_miller(random->a);
    *v = random->a << 1;
}

#else

/* The next two words, uniform in their upper bits. */
static inline void random_next_two(Random* random, lanes_u* u, lanes_u* v) {
    *u = random->a;
    *v = random->b;
    random->a = random->a * 0xeafbebfbu + random->b;
    random->b = random->b * 0xe4c341f9u + random->a;
}

#endif

/* Another sequence, for a path that takes as many numbers as its lane happens to trace along with others. */
static inline Random random_split(Random* random) {
    lanes_u u, v;
    random_next_two(random, &u, &v);
    Random other;
    other.a = random_mix(u);
    other.b = random_mix(v ^ 0x9e3779b9u);
#ifdef PTB_PARK_MILLER
    other.a = lanes_max_u(lanes_min_u(other.a >> 1, (lanes_u)(PARK_MILLER_MODULUS - 1u)), (lanes_u)(1u));
    other.b = (lanes_u)(0u);
#endif
    return other;
}

#endif
