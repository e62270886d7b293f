/* Random numbers: a generator per path, seeded by a hash of (pixel, sample), so a path's numbers depend on nothing
   else. The generator is xoroshiro64*: see "Scrambled Linear Pseudorandom Number Generators", by D. Blackman and
   S. Vigna. Its 64 bits of state make paths that share a stretch of numbers unlikely, and it needs only one 32-bit
   product, which every SIMD unit has. */
#ifndef PTB_LIB_RANDOM_H
#define PTB_LIB_RANDOM_H

#include "lib/lanes.h"

typedef struct Random {
    lanes_u a, b;
} Random;

/* A bijection of 32 bits whose every output bit depends on every input bit (xor-shift-multiply; the constants are
   those of C. Wellons' search for the least biased one). */
static inline lanes_u random_mix(lanes_u x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/* Two rounds would leave one half a function of 32 bits; three make the pair a bijection of (pixel, sample), so no
   two paths of an image start alike. */
static inline Random random_of_path(lanes_u pixel, lanes_u sample, uint seed) {
    Random random;
    random.a = random_mix(pixel + seed * 0x9e3779b9u);
    random.b = random_mix(sample + random.a);
    random.a = random_mix(random.a ^ random.b);
    return random;
}

/* The next number, uniform in [0, 1), a multiple of 2^-24. */
static inline lanes_f random_next(Random* random) {
    const lanes_u word = random->a * 0x9e3779bbu;
    const lanes_u mixed = random->a ^ random->b;
    random->a = ((random->a << 26) | (random->a >> 6)) ^ mixed ^ (mixed << 9);
    random->b = (mixed << 13) | (mixed >> 19);
    return lanes_to_f(lanes_as_i(word >> 8)) * 0x1p-24f;
}

#endif
