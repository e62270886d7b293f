/* Functions that stay functions of their own, for loops of a kernel. PoCL stores every variable of a kernel's
   loop to memory at each turn, but not those of a function that it does not inline: 10.3 -> 11.7 Msamples/s
   (two AVX-512 cores, PoCL 3.1). From version 5 on it takes noinline off functions whose vectors are wider
   than the machine's registers, which 32 lanes are with AVX-512 and 16 with AVX2. LLVM never inlines one that
   takes the address of a label in it, whatever its attributes say. */
#ifndef PTB_LIB_OUTLINED_H
#define PTB_LIB_OUTLINED_H

#include "lib/machine.h"

#define OUTLINED static __attribute__((noinline))

/* The first statement of an OUTLINED function. */
#ifdef POCL_DEVICE_ADDRESS_BITS /* PoCL's compiler says so */
#define STAY_OUTLINED \
    outlined:         \
    __asm__ volatile("" : : "r"(__extension__ &&outlined))
#else
#define STAY_OUTLINED (void)0
#endif

#endif
