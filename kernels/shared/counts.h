/* What an instrumented build of a kernel (-DPTB_COUNT) leaves: rows of these sums, which the host adds up. A sum is two
   words, the lower one first. Work-items share rows, so that any launch fits. */
#ifndef PTB_SHARED_COUNTS_H
#define PTB_SHARED_COUNTS_H

#define PTB_COUNTED_SEGMENTS 0  /* by lanes with a path */
#define PTB_COUNTED_LANES 1     /* of the steps that traced them, with a path or without; 0: cannot be seen */
#define PTB_COUNTED_FLOPS 2     /* f32 additions and multiplications */
#define PTB_COUNTED_ROOTS 3     /* and what a GPU's same unit does in one step: reciprocal roots, sines and cosines */
#define PTB_COUNTED_DIVISIONS 4
#define PTB_COUNTED_BYTES 5     /* of global memory, read or written, from a cache or not */
#define PTB_COUNTED_SEARCHES 6  /* through a tree of triangles: of segments and of shadow rays */
#define PTB_COUNTED_NODES 7     /* of it, met by them */
#define PTB_COUNTED_TRIANGLES 8 /* likewise, of a block all eight */
#define PTB_COUNTED_SUMS 9

#define PTB_COUNTED_ROWS 1024

#endif
