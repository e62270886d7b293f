/* The picture that says best what samples say of pixels and of differences between neighbours: a screened Poisson equation,

       minimise  sum of w_p |I - P|^2 + w_x |I(right) - I - X|^2 + w_y |I(below) - I - Y|^2,

   by conjugate gradients, scaled by the diagonal; colours are solved together. Each half of the samples is a problem of its
   own, `problem`, whose weights are 1 / variance as the other half tells it: so no weight knows the noise that it weighs, and
   the mean of both is unbiased. Sums over pixels are made in an order of their own, by work-groups of RECONSTRUCT_GROUP. */
#ifndef PTB_GBDPT_RECONSTRUCT_H
#define PTB_GBDPT_RECONSTRUCT_H

#include "shared/gradients.h"

#define RECONSTRUCT_PIXELS (RECONSTRUCT_GROUP * RECONSTRUCT_EACH)

/* Where a work-item's pixels lie. Groups are numbered problem by problem. */
typedef struct Share {
    uint problem, pixels, first, end; /* pixels of the problem, from first on by RECONSTRUCT_GROUP */
} Share;

static inline Share share_of(const ReconstructLaunch* r) {
    Share share;
    const uint group = (uint)get_group_id(0);
    share.pixels = r->width * r->height;
    share.problem = group / r->groups;
    const uint begin = group % r->groups * RECONSTRUCT_PIXELS;
    share.first = begin + (uint)get_local_id(0);
    share.end = min(begin + RECONSTRUCT_PIXELS, share.pixels);
    return share;
}

/* The sum of a work-group's numbers, in its first item. */
static inline float4 sum_of_group(__local float4* sums, float4 own) {
    const uint item = (uint)get_local_id(0);
    sums[item] = own;
    for (uint step = RECONSTRUCT_GROUP / 2u; step > 0u; step /= 2u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item < step) sums[item] += sums[item + step];
    }
    return item == 0u ? sums[0] : own;
}

static inline void leave_sum(__global float4* partials, __local float4* sums, float4 own) {
    const float4 sum = sum_of_group(sums, own);
    if (get_local_id(0) == 0) partials[get_group_id(0)] = sum;
}

static inline float4 float4_of(__global const long* sums) {
    return (float4)((float)sums[0], (float)sums[1], (float)sums[2], 0.0f);
}

/* Of a pixel: what is given, and the weights of it, as w. Across and down belong to the pixel's right and lower edge. */
typedef struct Given {
    float4 radiance, across, down;
} Given;

static inline Given given_of(__global const GradientPixel* sums, uint pixel, uint half_of_samples, const ReconstructLaunch* r) {
    __global const GradientPixel* place = sums + half_of_samples * (r->width * r->height) + pixel;
    const float scale = 1.0f / r->radiance_scale;
    const Given given = {float4_of(place->radiance) * scale, float4_of(place->across) * scale, float4_of(place->down) * scale};
    return given;
}

/* Sums of all pixels: squares of the three, of both halves, and brightness. */
__kernel void KERNEL(measure)(__global const GradientPixel* sums, __global float4* partials, const ReconstructLaunch r) {
    __local float4 group_sums[RECONSTRUCT_GROUP];
    const Share share = share_of(&r);
    float4 sum = (float4)(0.0f);
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP) {
        for (uint h = 0; h < 2u; ++h) {
            __global const GradientPixel* place = sums + h * share.pixels + i;
            const float4 radiance = float4_of(place->radiance);
            sum += (float4)(float4_of(place->squares).xyz / r.squares_scale,
                            (radiance.x + radiance.y + radiance.z) / (3.0f * r.radiance_scale));
        }
    }
    leave_sum(partials, group_sums, sum);
}

/* Adds the sums of work-groups: of each problem into its row of `scalars`. */
__kernel void KERNEL(total)(__global const float4* partials, __global float4* scalars, const uint place, const ReconstructLaunch r) {
    __local float4 group_sums[RECONSTRUCT_GROUP];
    const uint problem = (uint)get_group_id(0);
    float4 sum = (float4)(0.0f);
    for (uint i = (uint)get_local_id(0); i < r.groups; i += RECONSTRUCT_GROUP) sum += partials[problem * r.groups + i];
    sum = sum_of_group(group_sums, sum);
    if (get_local_id(0) == 0) scalars[problem * RECONSTRUCT_SCALARS + place] = sum;
}

/* Variance of the means over so many samples, of a pixel and its eight neighbours. */
static inline float4 variance_around(__global const GradientPixel* sums, uint pixel, uint half_of_samples, const ReconstructLaunch* r) {
    const uint column = pixel % r->width, row = pixel / r->width;
    const uint left = column > 0u ? column - 1u : 0u, right = min(column + 1u, r->width - 1u);
    const uint above = row > 0u ? row - 1u : 0u, below = min(row + 1u, r->height - 1u);
    float4 sum = (float4)(0.0f);
    for (uint y = above; y <= below; ++y)
        for (uint x = left; x <= right; ++x)
            sum += float4_of(sums[half_of_samples * (r->width * r->height) + y * r->width + x].squares);
    const float n = (float)max(r->samples[half_of_samples], 1u);
    return sum / (r->squares_scale * n * n * (float)((right - left + 1u) * (below - above + 1u)));
}

/* What each problem is given, with its weights, and what is tried first: the picture without gradients. */
__kernel void KERNEL(give)(__global const GradientPixel* sums, __global float4* given, __global float4* solution,
                           __global const float4* scalars, const ReconstructLaunch r) {
    const Share share = share_of(&r);
    const float4 all = scalars[RECONSTRUCT_MEASURED];
    const float n = (float)(r.samples[0] + r.samples[1]);
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP) {
        Given own = given_of(sums, i, share.problem, &r);
        float4 weights = (float4)(RECONSTRUCT_ALPHA * RECONSTRUCT_ALPHA, 1.0f, 1.0f, 0.0f);
        if (r.problems == 2u) {
            const float inverse = 1.0f / (float)r.samples[share.problem];
            own.radiance *= inverse;
            own.across *= inverse;
            own.down *= inverse;
            /* a pixel where nothing was seen to vary is no more certain than this */
            const float4 least = all * (RECONSTRUCT_CERTAIN / (n * n * (float)share.pixels)) + 1e-30f;
            weights = 1.0f / (variance_around(sums, i, 1u - share.problem, &r) + least);
        } else {
            const Given other = given_of(sums, i, 1u, &r);
            own.radiance = (own.radiance + other.radiance) / n;
            own.across = (own.across + other.across) / n;
            own.down = (own.down + other.down) / n;
        }
        const bool last_column = i % r.width + 1u == r.width, last_row = i + r.width >= share.pixels;
        __global float4* place = given + 3u * (share.problem * share.pixels + i);
        place[0] = (float4)(own.radiance.xyz, weights.x);
        place[1] = (float4)(own.across.xyz, last_column ? 0.0f : weights.y);
        place[2] = (float4)(own.down.xyz, last_row ? 0.0f : weights.z);
        solution[share.problem * share.pixels + i] = own.radiance;
    }
}

/* Weights for sums of absolute values in place of squares: see "Gradient-Domain Path Tracing", by M. Kettunen et al. */
__kernel void KERNEL(reweigh)(__global float4* given, __global const float4* solution, __global const float4* scalars,
                              const float nearness, const ReconstructLaunch r) {
    const Share share = share_of(&r);
    const float bright = scalars[RECONSTRUCT_MEASURED].w / ((float)(r.samples[0] + r.samples[1]) * (float)share.pixels);
    const float least = nearness * bright + 1e-30f;
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP) {
        __global float4* place = given + 3u * i;
        const float4 here = solution[i];
        const float4 off = here - place[0];
        place[0].w = RECONSTRUCT_ALPHA / (RECONSTRUCT_ALPHA * length(off.xyz) + least);
        if (place[1].w > 0.0f) place[1].w = 1.0f / (length((solution[i + 1u] - here - place[1]).xyz) + least);
        if (place[2].w > 0.0f) place[2].w = 1.0f / (length((solution[i + r.width] - here - place[2]).xyz) + least);
    }
}

/* A pixel's edges: to the right and below, and, as its neighbours have them, to the left and above. */
typedef struct PixelEdges {
    float right, below, left, above; /* weights; 0 where the picture ends */
    uint to_left, to_above;          /* how far they are */
} PixelEdges;

static inline PixelEdges pixel_edges(__global const float4* given, uint pixel, const ReconstructLaunch* r) {
    PixelEdges edges;
    edges.to_left = pixel % r->width > 0u ? 1u : 0u;
    edges.to_above = pixel >= r->width ? r->width : 0u;
    edges.right = given[3u * pixel + 1u].w;
    edges.below = given[3u * pixel + 2u].w;
    edges.left = edges.to_left > 0u ? given[3u * (pixel - edges.to_left) + 1u].w : 0.0f;
    edges.above = edges.to_above > 0u ? given[3u * (pixel - edges.to_above) + 2u].w : 0.0f;
    return edges;
}

static inline float4 scaled_by_diagonal(float4 residual, __global const float4* given, uint pixel, const PixelEdges* edges) {
    return residual / (given[3u * pixel].w + (edges->right + edges->left) + (edges->below + edges->above));
}

static inline float product(float4 a, float4 b) { return dot(a.xyz, b.xyz); }

/* The residual of what is tried first, and the way to go from there. */
__kernel void KERNEL(begin)(__global const float4* given, __global const float4* solution, __global float4* residual,
                            __global float4* way, __global float4* partials, const ReconstructLaunch r) {
    __local float4 group_sums[RECONSTRUCT_GROUP];
    const Share share = share_of(&r);
    __global const float4* own = given + 3u * share.problem * share.pixels;
    __global const float4* x = solution + share.problem * share.pixels;
    float4 sum = (float4)(0.0f);
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP) {
        const PixelEdges edges = pixel_edges(own, i, &r);
        float4 rest = own[3u * i].w * (own[3u * i] - x[i]);
        if (edges.right > 0.0f) rest += edges.right * (x[i + 1u] - x[i] - own[3u * i + 1u]);
        if (edges.below > 0.0f) rest += edges.below * (x[i + r.width] - x[i] - own[3u * i + 2u]);
        if (edges.left > 0.0f) rest -= edges.left * (x[i] - x[i - 1u] - own[3u * (i - 1u) + 1u]);
        if (edges.above > 0.0f) rest -= edges.above * (x[i] - x[i - r.width] - own[3u * (i - r.width) + 2u]);
        rest.w = 0.0f;
        const float4 scaled = scaled_by_diagonal(rest, own, i, &edges);
        residual[share.problem * share.pixels + i] = rest;
        way[share.problem * share.pixels + i] = scaled;
        sum.x += product(rest, scaled);
    }
    leave_sum(partials, group_sums, sum);
}

/* What the equation makes of the way. */
__kernel void KERNEL(apply)(__global const float4* given, __global const float4* way, __global float4* applied,
                            __global float4* partials, const ReconstructLaunch r) {
    __local float4 group_sums[RECONSTRUCT_GROUP];
    const Share share = share_of(&r);
    __global const float4* own = given + 3u * share.problem * share.pixels;
    __global const float4* p = way + share.problem * share.pixels;
    float4 sum = (float4)(0.0f);
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP) {
        const PixelEdges edges = pixel_edges(own, i, &r);
        const float4 here = p[i];
        float4 q = own[3u * i].w * here;
        if (edges.right > 0.0f) q += edges.right * (here - p[i + 1u]);
        if (edges.below > 0.0f) q += edges.below * (here - p[i + r.width]);
        if (edges.left > 0.0f) q += edges.left * (here - p[i - 1u]);
        if (edges.above > 0.0f) q += edges.above * (here - p[i - r.width]);
        applied[share.problem * share.pixels + i] = q;
        sum.x += product(here, q);
    }
    leave_sum(partials, group_sums, sum);
}

static inline float over(float a, float b) { return b > 0.0f ? a / b : 0.0f; }

/* Goes as far along the way as is best. */
__kernel void KERNEL(step)(__global const float4* given, __global float4* solution, __global float4* residual,
                           __global const float4* way, __global const float4* applied, __global const float4* scalars,
                           __global float4* partials, const uint turn, const ReconstructLaunch r) {
    __local float4 group_sums[RECONSTRUCT_GROUP];
    const Share share = share_of(&r);
    __global const float4* own = given + 3u * share.problem * share.pixels;
    __global const float4* row = scalars + share.problem * RECONSTRUCT_SCALARS;
    const float far = over(row[RECONSTRUCT_RESIDUAL + turn % 2u].x, row[RECONSTRUCT_APPLIED].x);
    float4 sum = (float4)(0.0f);
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP) {
        const uint place = share.problem * share.pixels + i;
        solution[place] += far * way[place];
        const float4 rest = residual[place] - far * applied[place];
        residual[place] = rest;
        const PixelEdges edges = pixel_edges(own, i, &r);
        sum.x += product(rest, scaled_by_diagonal(rest, own, i, &edges));
    }
    leave_sum(partials, group_sums, sum);
}

/* Turns into the next way. */
__kernel void KERNEL(turn)(__global const float4* given, __global const float4* residual, __global float4* way,
                           __global const float4* scalars, const uint turn, const ReconstructLaunch r) {
    const Share share = share_of(&r);
    __global const float4* own = given + 3u * share.problem * share.pixels;
    __global const float4* row = scalars + share.problem * RECONSTRUCT_SCALARS + RECONSTRUCT_RESIDUAL;
    const float kept = over(row[(turn + 1u) % 2u].x, row[turn % 2u].x);
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP) {
        const uint place = share.problem * share.pixels + i;
        const PixelEdges edges = pixel_edges(own, i, &r);
        way[place] = scaled_by_diagonal(residual[place], own, i, &edges) + kept * way[place];
    }
}

/* The mean of both problems, by their samples. */
__kernel void KERNEL(picture)(__global float4* solution, const ReconstructLaunch r) {
    const Share share = share_of(&r);
    const float n = (float)(r.samples[0] + r.samples[1]);
    for (uint i = share.first; i < share.end; i += RECONSTRUCT_GROUP)
        solution[i] = (solution[i] * (float)r.samples[0] + solution[share.pixels + i] * (float)r.samples[1]) / n;
}

#endif
