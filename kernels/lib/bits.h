/* Bits of words, and of the masks of vectors. */
#ifndef PTB_LIB_BITS_H
#define PTB_LIB_BITS_H

#include "lib/machine.h"

/* The number of the lowest set bit of a word that has one. */
static inline uint lowest_bit(uint word) {
#if defined(__x86_64__) && PTB_HAS(__builtin_ctz)
    return (uint)__builtin_ctz(word);
#else
    return 31u - clz(word & (0u - word));
#endif
}

/* A bit for each element of a mask, that of the first one lowest. */
static inline uint bits_of_mask(int8 mask) {
#if defined(__AVX__) && PTB_HAS(__builtin_ia32_movmskps256)
    return (uint)__builtin_ia32_movmskps256(as_float8(mask));
#else
    const int8 bits = mask & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 four = bits.lo | bits.hi;
    const int2 two = four.lo | four.hi;
    return (uint)(two.x | two.y);
#endif
}

#endif
