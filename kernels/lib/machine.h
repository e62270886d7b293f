/* What this compiler and machine offer beyond OpenCL C 1.2. Every use has a portable twin beside it; PTB_PORTABLE
   switches them all off, to measure what they are worth. */
#ifndef PTB_LIB_MACHINE_H
#define PTB_LIB_MACHINE_H

#include "lib/strict.h"

/* Vectors wider than the machine's registers are passed between functions in another way than on machines that have such
   registers: of no concern where all functions are inlined or take none. */
#ifdef __clang__
#pragma clang diagnostic ignored "-Wpsabi"
#endif

#if !defined(PTB_PORTABLE) && defined(__has_builtin)
#define PTB_HAS(builtin) __has_builtin(builtin)
#else
#define PTB_HAS(builtin) 0
#endif

/* Of functions that are called twice and would be left a call, with vectors passed through memory and loops of unknown
   length: 1.06 times as slow (`pt_nee`, two AVX-512 cores, PoCL). Oclgrind, which does not optimise, does not know what that
   leaves in the code. */
#ifdef __OPTIMIZE__
#define ALWAYS_INLINE static inline __attribute__((always_inline))
#else
#define ALWAYS_INLINE static inline
#endif

/* One ray a work-item is best on GPUs, see lib/lanes.h. */
#ifndef PTB_LANES
#define PTB_LANES 1
#endif

/* Floats in a register of the device, where the host tells: of CPUs. Intel's compiler reads the text before it knows the
   machine, and defines no macro of it. */
#ifndef PTB_WIDTH
#define PTB_WIDTH 1
#endif

/* Floats in a register where clang's vectors are made use of: 16 (AVX-512), 8 (AVX2) or 0. */
#if PTB_WIDTH >= 16 && PTB_LANES >= 16 && PTB_HAS(__builtin_shufflevector)
#define PTB_SIMD 16
#elif PTB_WIDTH >= 8 && PTB_LANES >= 8 && PTB_HAS(__builtin_shufflevector)
#define PTB_SIMD 8
#else
#define PTB_SIMD 0
#endif

/* clang's reduction of a vector, which Oclgrind does not know. It belongs to no machine, so it is portable text too. */
#define PTB_REDUCES 0
#if defined(__x86_64__) && defined(__has_builtin)
#if __has_builtin(__builtin_reduce_or)
#undef PTB_REDUCES
#define PTB_REDUCES 1
#endif
#endif

/* NVIDIA's instructions, as inline assembler. */
#if PTB_LANES == 1 && !defined(PTB_PORTABLE) && (defined(__NV_CL_C_VERSION) || defined(cl_nv_pragma_unroll))
#define PTB_PTX 1
#else
#define PTB_PTX 0
#endif

/* Where registers are scarce: a variable lies in private memory here, and is read anew from there. */
#if PTB_PTX
#define KEEP_IN_MEMORY(variable) __asm__ volatile("" : : "l"(&(variable)) : "memory")
#else
#define KEEP_IN_MEMORY(variable) (void)0
#endif

#endif
