/* Lanes: one work-item traces PTB_LANES rays together (1, 4, 8, 16 or 32). On CPUs the compiler keeps a kernel with one
   ray a work-item scalar, while explicit vectors become SIMD registers; twice as many lanes as a register holds
   interleave two rays' arithmetic, one filling the waits of the other. On GPUs one lane a work-item is best.
   Everything below has the same spelling and meaning for every width. A mask is what a comparison gives; it is used
   with &, |, ! and lanes_select only. */
#ifndef PTB_LIB_LANES_H
#define PTB_LIB_LANES_H

#include "lib/machine.h"

#if PTB_LANES == 1

typedef float lanes_f;
typedef int lanes_i;
typedef uint lanes_u;
typedef bool lanes_mask;
#define LANE(value, lane) (value)
#define lanes_as_f as_float
#define lanes_as_i as_int
#define lanes_as_u as_uint
#define lanes_to_f(x) ((float)(x))
#define lanes_to_u(x) ((uint)(x))
static inline bool lanes_any(lanes_mask mask) { return mask; }
static inline lanes_mask lanes_none(void) { return false; }
static inline lanes_mask lanes_all(void) { return true; }

#else

#define PTB_GLUE_(a, b) a##b
#define PTB_GLUE(a, b) PTB_GLUE_(a, b)
#if PTB_LANES == 32 /* wider than OpenCL C knows: an extension of clang, on which PoCL's and Intel's compilers rest */
typedef __attribute__((ext_vector_type(32))) float float32;
typedef __attribute__((ext_vector_type(32))) int int32;
typedef __attribute__((ext_vector_type(32))) uint uint32;
#define as_float32(x) __builtin_astype(x, float32)
#define as_int32(x) __builtin_astype(x, int32)
#define as_uint32(x) __builtin_astype(x, uint32)
#endif
typedef PTB_GLUE(float, PTB_LANES) lanes_f;
typedef PTB_GLUE(int, PTB_LANES) lanes_i;
typedef PTB_GLUE(uint, PTB_LANES) lanes_u;
typedef PTB_GLUE(int, PTB_LANES) lanes_mask;
#define LANE(value, lane) ((value)[lane])
#define lanes_as_f PTB_GLUE(as_float, PTB_LANES)
#define lanes_as_i PTB_GLUE(as_int, PTB_LANES)
#define lanes_as_u PTB_GLUE(as_uint, PTB_LANES)
/* Of whole numbers below 2^31, by way of signed ones: x86 has no other conversion before AVX-512. */
#if PTB_LANES == 32
#define lanes_to_f(x) __builtin_convertvector(lanes_as_i(x), lanes_f)
#define lanes_to_u(x) lanes_as_u(__builtin_convertvector(x, lanes_i))
#else
#define lanes_to_f(x) PTB_GLUE(convert_float, PTB_LANES)(lanes_as_i(x))
#define lanes_to_u(x) lanes_as_u(PTB_GLUE(convert_int, PTB_LANES)(x))
#endif
/* `any` of a vector takes a dozen instructions on x86, the reduction one. */
#if PTB_REDUCES
static inline bool lanes_any(lanes_mask mask) { return __builtin_reduce_or(mask) != 0; }
#elif PTB_LANES == 32
static inline bool lanes_any(lanes_mask mask) { return any(mask.lo | mask.hi); }
#else
static inline bool lanes_any(lanes_mask mask) { return any(mask); }
#endif
static inline lanes_mask lanes_none(void) { return (lanes_mask)(0); }
static inline lanes_mask lanes_all(void) { return (lanes_mask)(-1); }

#endif

/* The lanes of a mask as bits, the first one lowest: by an instruction a register where the machine has it. */
#if PTB_SIMD == 16 && defined(__AVX512DQ__) && PTB_HAS(__builtin_ia32_cvtd2mask512)
#define MASK_BITS(part) ((uint)(ushort)__builtin_ia32_cvtd2mask512(part))
#elif PTB_SIMD == 8 && defined(__AVX__) && PTB_HAS(__builtin_ia32_movmskps256)
#define MASK_BITS(part) ((uint)__builtin_ia32_movmskps256(as_float8(part)))
#endif
static inline uint lanes_bits(lanes_mask mask) {
#if defined(MASK_BITS) && PTB_LANES == PTB_SIMD
    return MASK_BITS(mask);
#elif defined(MASK_BITS) && PTB_LANES == 2 * PTB_SIMD
    return MASK_BITS(mask.lo) | MASK_BITS(mask.hi) << PTB_SIMD;
#else
    uint bits = 0u;
    for (uint lane = 0; lane < PTB_LANES; ++lane) bits |= (LANE(mask, lane) ? 1u : 0u) << lane;
    return bits;
#endif
}

/* The value, which must be in registers here and which the compiler cannot look through; of use with AVX2 only. There
   masks are whole registers, but LLVM packs one that outlives its block into bytes, and unpacks it at every use: 1.03 (two
   Zen 3 cores, PoCL). */
static inline lanes_i lanes_hold(lanes_i value) {
#if PTB_SIMD == 8 && PTB_LANES == 8 && defined(__AVX2__)
    __asm__ volatile("" : "+x"(value));
#elif PTB_SIMD == 8 && PTB_LANES == 16 && defined(__AVX2__)
    int8 low = value.lo, high = value.hi;
    __asm__ volatile("" : "+x"(low), "+x"(high));
    value = (int16)(low, high);
#endif
    return value;
}

/* The same for NVIDIA's compiler, which otherwise makes a value anew at every use, or in another register to be copied. */
static inline uint uint_hold(uint value) {
#if PTB_PTX
    __asm__ volatile("" : "+r"(value));
#endif
    return value;
}

/* The mask, where the lanes of a warp meet again that left a loop at different turns because of it. NVIDIA's compiler must
   not see that: it would send those that left early on alone. 3.20 -> 4.03 Gsamples/s (H200). */
static inline lanes_mask lanes_meet(lanes_mask mask) {
#if PTB_PTX
    int hidden = mask;
    __asm__ volatile("" : "+r"(hidden));
    return hidden != 0;
#else
    return mask;
#endif
}

/* The lanes of the warp that are here, and where these wait for each other. */
static inline uint warp_here(void) {
    uint here = 0u;
#if PTB_PTX
    __asm__ volatile("activemask.b32 %0;" : "=r"(here));
#endif
    return here;
}
static inline void warp_meets(uint here) {
#if PTB_PTX
    __asm__ volatile("bar.warp.sync %0;" : : "r"(here) : "memory");
#else
    (void)here;
#endif
}

/* A lane alone goes where its branches go, and needs no mask there. */
#define MASK_OF_MANY(mask) (PTB_LANES > 1 ? (mask) : lanes_all())

/* if_true where the mask is set, if_false elsewhere. */
static inline lanes_f lanes_select(lanes_f if_false, lanes_f if_true, lanes_mask mask) {
    return mask ? if_true : if_false;
}
static inline lanes_u lanes_select_u(lanes_u if_false, lanes_u if_true, lanes_mask mask) {
    return mask ? if_true : if_false;
}

#define LANES_SIGN 0x80000000u /* of a float */
#if PTB_LANES == 1
static inline lanes_f lanes_abs(lanes_f a) { return fabs(a); }
#else
static inline lanes_f lanes_abs(lanes_f a) { return lanes_as_f(lanes_as_u(a) & ~LANES_SIGN); }
#endif
/* With a NaN, b: one instruction, where fmin and fmax take four. */
static inline lanes_f lanes_min(lanes_f a, lanes_f b) { return lanes_select(b, a, a < b); }
static inline lanes_f lanes_max(lanes_f a, lanes_f b) { return lanes_select(b, a, a > b); }
static inline lanes_u lanes_min_u(lanes_u a, lanes_u b) { return lanes_select_u(b, a, a < b); }
static inline lanes_u lanes_max_u(lanes_u a, lanes_u b) { return lanes_select_u(b, a, a > b); }

/* n / d for n below 2^31 and quotients below 2^22; inverse is 1 / d, rounded. Neither SIMD nor GPUs have such a division,
   so a product that is off by one at most, put right. */
static inline lanes_u lanes_divide(lanes_u n, uint d, float inverse) {
    const lanes_u q = lanes_to_u(lanes_to_f(n) * inverse);
    const lanes_i rest = lanes_as_i(n - q * d);
    const lanes_u none = (lanes_u)(0u), one = (lanes_u)(1u);
    return q + lanes_select_u(none, one, rest >= (lanes_i)((int)d)) - lanes_select_u(none, one, rest < 0);
}

#endif
