/* Square roots. */
#ifndef PTB_LIB_ROOTS_H
#define PTB_LIB_ROOTS_H

#include "lib/lanes.h"

#ifdef PTB_STRICT
#define SQRT sqrt
#else
#define SQRT native_sqrt
#endif

/* NaN for negative numbers; a denormal one may count as zero. */
static inline lanes_f lanes_sqrt(lanes_f x) {
#if PTB_PTX
    /* The compiler's own choice rescales denormals, three more instructions a root, whatever the flags. */
    float root;
    __asm__("sqrt.approx.ftz.f32 %0, %1;" : "=f"(root) : "f"(x));
    return root;
#elif PTB_LANES == 32
    return (lanes_f)(SQRT(x.lo), SQRT(x.hi));
#else
    return SQRT(x);
#endif
}

/* 1 / sqrt of a register, to 12 bits or more, in an instruction. */
#if PTB_SIMD == 16 && defined(__AVX512F__) && PTB_HAS(__builtin_ia32_rsqrt14ps512_mask)
#define RSQRT_ESTIMATE(x) __builtin_ia32_rsqrt14ps512_mask(x, x, (ushort)-1)
#elif PTB_SIMD == 8 && defined(__AVX__) && PTB_HAS(__builtin_ia32_rsqrtps256)
#define RSQRT_ESTIMATE(x) __builtin_ia32_rsqrtps256(x)
#elif PTB_SIMD && defined(__INTEL_LLVM_COMPILER)
#define RSQRT_ESTIMATE native_rsqrt
#endif
#if defined(RSQRT_ESTIMATE) && (PTB_LANES == PTB_SIMD || PTB_LANES == 2 * PTB_SIMD)
#define RSQRT_ESTIMATED 1
#else
#define RSQRT_ESTIMATED 0
#endif

#if RSQRT_ESTIMATED && PTB_LANES == PTB_SIMD
static inline lanes_f lanes_rsqrt_estimate(lanes_f x) { return RSQRT_ESTIMATE(x); }
#elif RSQRT_ESTIMATED
static inline lanes_f lanes_rsqrt_estimate(lanes_f x) { return (lanes_f)(RSQRT_ESTIMATE(x.lo), RSQRT_ESTIMATE(x.hi)); }
#endif

/* The square root to a few ulp, NaN for 0 too, where other roots wait for the machine's unit: by a Newton step with
   AVX-512. Every second root of `pt` so: 1.23 (two cores of a Xeon, PoCL), 1.14 (Intel's runtime); 0.99 with AVX2. */
#if RSQRT_ESTIMATED && PTB_SIMD == 16
#define SQRT_ESTIMATED 1
static inline lanes_f lanes_sqrt_beside(lanes_f x) {
    const lanes_f y = lanes_rsqrt_estimate(x), root = x * y;
    return root + 0.5f * y * (x - root * root);
}
#else
#define SQRT_ESTIMATED 0
#define lanes_sqrt_beside lanes_sqrt
#endif

/* 1 / sqrt(x) for normal x > 0, to a few ulp. */
static inline lanes_f lanes_rsqrt(lanes_f x) {
#if PTB_PTX
    float root;
    __asm__("rsqrt.approx.ftz.f32 %0, %1;" : "=f"(root) : "f"(x));
    return root;
#elif RSQRT_ESTIMATED
    /* An estimate and a Newton step, where the portable form is a root and a division. */
    const lanes_f y = lanes_rsqrt_estimate(x);
    return y * (1.5f - 0.5f * x * y * y);
#else
    return 1.0f / lanes_sqrt(x);
#endif
}

#endif
