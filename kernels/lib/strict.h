/* -DPTB_STRICT: arithmetic as IEEE 754 has it. Nothing is contracted, and no machine's own instructions are used. */
#ifndef PTB_LIB_STRICT_H
#define PTB_LIB_STRICT_H

#ifdef PTB_STRICT
#pragma OPENCL FP_CONTRACT OFF
#define PTB_PORTABLE
#endif

#endif
