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

/* 1 / sqrt(x) for normal x > 0, to a few ulp. */
static inline lanes_f lanes_rsqrt(lanes_f x) {
#if PTB_PTX
    float root;
    __asm__("rsqrt.approx.ftz.f32 %0, %1;" : "=f"(root) : "f"(x));
    return root;
#elif RSQRT_ESTIMATED
    /* An estimate and a Newton step, where the portable form is a root and a division. */
#if PTB_LANES == PTB_SIMD
    const lanes_f y = RSQRT_ESTIMATE(x);
#else
    const lanes_f y = (lanes_f)(RSQRT_ESTIMATE(x.lo), RSQRT_ESTIMATE(x.hi));
#endif
    return y * (1.5f - 0.5f * x * y * y);
#else
    return 1.0f / lanes_sqrt(x);
#endif
}

#endif
