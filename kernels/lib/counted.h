/* A kernel counts its own work in a build of its own, with PTB_COUNT. Without it, nothing of this reaches the compiler:
   the macros leave no token behind (so a line with one has no semicolon), and the measured build is what it was.

   COUNTED(times, WORK) counts WORK, a macro of four numbers: f32 additions and multiplications (a multiply-add is
   two), roots, divisions, and bytes of global memory. Comparisons, selections, conversions and whole numbers are no
   arithmetic here. After lib/lanes.h, COUNTED_LANES(mask, WORK) counts it for each lane of the mask. */
#ifndef PTB_LIB_COUNTED_H
#define PTB_LIB_COUNTED_H

#include "lib/machine.h"
#include "shared/counts.h"

#ifdef PTB_COUNT

/* The sums of a work-item, handed down. */
#define COUNTED_PARAMETER , ulong* counted
#define COUNTED_ARGUMENT , counted
/* The last argument of a kernel, and its first and last line. */
#define COUNTED_ROWS , __global uint* counted_rows
#define COUNTED_BEGIN ulong counted[PTB_COUNTED_SUMS] = {0};
#define COUNTED_END counted_add(counted_rows, counted);

#define COUNTED(times, WORK) counted_work(counted, times, WORK);
#define COUNTED_LANES(mask, WORK) counted_work(counted, counted_lanes(mask), WORK);
/* So many segments, traced together. */
#define COUNTED_SEGMENTS(live) counted_segments(counted, live);
/* Steps of a search: PTB_COUNTED_SEARCHES, _NODES, _TRIANGLES. */
#define COUNTED_STEPS(sum, steps) counted[sum] += (steps);
/* In a function that is handed the sums for its twin's sake. */
#define COUNTED_UNUSED (void)counted;

#ifdef PTB_LIB_LANES_H
static inline uint counted_lanes(lanes_mask mask) {
    uint lanes = 0u;
    for (uint lane = 0u; lane < PTB_LANES; ++lane) lanes += LANE(mask, lane) ? 1u : 0u;
    return lanes;
}
#endif

static inline void counted_work(ulong* counted, uint times, uint flops, uint roots, uint divisions, uint bytes) {
    counted[PTB_COUNTED_FLOPS] += (ulong)times * flops;
    counted[PTB_COUNTED_ROOTS] += (ulong)times * roots;
    counted[PTB_COUNTED_DIVISIONS] += (ulong)times * divisions;
    counted[PTB_COUNTED_BYTES] += (ulong)times * bytes;
}

/* Lanes of a step: a work-item's own; with one a work-item those of the warp that runs it, of which the first one
   running counts all. Other machines do not say who runs with whom. */
static inline uint counted_lanes_of_step(void) {
#if PTB_LANES > 1
    return PTB_LANES;
#elif PTB_PTX
    uint running, lane;
    __asm__ volatile("activemask.b32 %0;" : "=r"(running));
    __asm__ volatile("mov.u32 %0, %%laneid;" : "=r"(lane));
    return (running & ((1u << lane) - 1u)) == 0u ? 32u : 0u;
#else
    return 0u;
#endif
}

static inline void counted_segments(ulong* counted, uint live) {
    counted[PTB_COUNTED_SEGMENTS] += live;
    counted[PTB_COUNTED_LANES] += counted_lanes_of_step();
}

/* Adds the sums to a row that work-items share: 64 bits of two words, without 64-bit atomics. */
static inline void counted_add(__global uint* rows, const ulong* counted) {
    const uint item = (uint)get_global_id(0) + (uint)get_global_id(1) * (uint)get_global_size(0);
    volatile __global uint* row = rows + item % PTB_COUNTED_ROWS * PTB_COUNTED_SUMS * 2u;
    for (uint i = 0u; i < PTB_COUNTED_SUMS; ++i) {
        const uint low = (uint)counted[i];
        const uint before = atomic_add(&row[2u * i], low);
        atomic_add(&row[2u * i + 1u], (uint)(counted[i] >> 32) + (before + low < before ? 1u : 0u));
    }
}

#else

#define COUNTED_PARAMETER
#define COUNTED_ARGUMENT
#define COUNTED_ROWS
#define COUNTED_BEGIN
#define COUNTED_END
#define COUNTED(times, WORK)
#define COUNTED_LANES(mask, WORK)
#define COUNTED_SEGMENTS(live)
#define COUNTED_STEPS(sum, steps)
#define COUNTED_UNUSED

#endif

#endif
