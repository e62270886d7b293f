/* What a device can do at most. Each kernel repeats one thing, in chains that do not wait for each other, and leaves a
   number that tells how often: the host compares it, so nothing can be left out. Work-items have PTB_LANES lanes as the
   tracers' have, at most 16; the starts come from the host, so that no compiler knows them. Loops are unrolled since their own turns
   take time: an H200 does 47, 61, 63, 65 TFLOP/s with 1, 4, 8, 16 steps in one. */
#include "lib/lanes.h"

#define CHAINS 8

/* Starts are PTB_LANES numbers a chain. */
static inline lanes_f start_of(__global const float* starts, int chain) {
#if PTB_LANES == 1
    return starts[chain];
#else
    return PTB_GLUE(vload, PTB_LANES)(chain, starts);
#endif
}

static inline float sum_of_lanes(lanes_f value) {
    float sum = 0.0f;
    for (int lane = 0; lane < PTB_LANES; ++lane) sum += LANE(value, lane);
    return sum;
}

static inline void leave_sum(__global float* out, const lanes_f* chains) {
    float sum = 0.0f;
    for (int c = 0; c < CHAINS; ++c) sum += sum_of_lanes(chains[c]);
    out[get_global_id(0)] = sum;
}

/* x + steps, where the factor and the term are 1. */
__kernel void peak_fma(__global float* out, __global const float* starts, const uint steps, const float one) {
    lanes_f x[CHAINS];
    for (int c = 0; c < CHAINS; ++c) x[c] = start_of(starts, c);
#pragma unroll 16
    for (uint i = 0; i < steps; ++i) {
#pragma unroll
        for (int c = 0; c < CHAINS; ++c) x[c] = x[c] * one + one;
    }
    leave_sum(out, x);
}

/* The root of x^2 + steps. */
__kernel void peak_sqrt(__global float* out, __global const float* starts, const uint steps, const float one) {
    lanes_f x[CHAINS];
    for (int c = 0; c < CHAINS; ++c) x[c] = start_of(starts, c);
#pragma unroll 16
    for (uint i = 0; i < steps; ++i) {
#pragma unroll
        for (int c = 0; c < CHAINS; ++c) x[c] = sqrt(x[c] * x[c] + one);
    }
    leave_sum(out, x);
}

/* 1 / (1 / x + steps). */
__kernel void peak_division(__global float* out, __global const float* starts, const uint steps, const float one) {
    lanes_f x[CHAINS];
    for (int c = 0; c < CHAINS; ++c) x[c] = start_of(starts, c);
#pragma unroll 16
    for (uint i = 0; i < steps; ++i) {
#pragma unroll
        for (int c = 0; c < CHAINS; ++c) x[c] = x[c] / (x[c] + one);
    }
    leave_sum(out, x);
}

#if PTB_LANES == 1
typedef float4 wide_f; /* what a GPU's work-item loads at once */
static inline float sum_of_wide(wide_f v) { return v.x + v.y + v.z + v.w; }
#else
typedef lanes_f wide_f;
static inline float sum_of_wide(wide_f v) { return sum_of_lanes(v); }
#endif

/* The sum of all of `data`, `steps` vectors a work-item: neighbours read neighbours, a work-group its own piece. */
__kernel void peak_global(__global float* out, __global const wide_f* data, const uint steps) {
    const size_t items = get_local_size(0);
    size_t at = get_group_id(0) * items * steps + get_local_id(0);
    wide_f sum = (wide_f)(0.0f);
    for (uint i = 0; i < steps; ++i, at += items) sum += data[at];
    out[get_global_id(0)] = sum_of_wide(sum);
}

/* The sum of `steps` x CHAINS reads of a table of 1024 numbers, the same ones for all work-items. */
__kernel void peak_constant(__global float* out, __constant const float* table, const uint steps) {
    lanes_f sum[CHAINS];
    for (int c = 0; c < CHAINS; ++c) sum[c] = (lanes_f)(0.0f);
#pragma unroll 16
    for (uint i = 0; i < steps; ++i) {
#pragma unroll
        for (int c = 0; c < CHAINS; ++c) sum[c] += table[(i * CHAINS + c) % 1024];
    }
    leave_sum(out, sum);
}

__kernel void peak_nothing(__global float* out) { out[0] = 1.0f; }
