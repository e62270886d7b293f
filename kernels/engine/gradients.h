/* Gradients: what samples tell of how a pixel differs from its neighbours. */
#ifndef PTB_ENGINE_GRADIENTS_H
#define PTB_ENGINE_GRADIENTS_H

#include "engine/splat.h"

/* Neighbours by number: right, left, below, above. */
#define NEIGHBOURS 4

/* What a sample, or several of one pixel, say of it and of how much more its neighbours have. */
typedef struct Gradients {
    Vec toward[NEIGHBOURS];
} Gradients;

/* The sums of a unit. */
typedef struct GradientSums {
    Gradients sum;
    lanes_f squares[NEIGHBOURS + 1]; /* of means over colours; the last are the pixel's own */
} GradientSums;

static inline GradientSums no_gradient_sums(void) {
    GradientSums sums;
    for (uint i = 0; i < NEIGHBOURS; ++i) sums.sum.toward[i] = vec_of((float4)(0.0f));
    for (uint i = 0; i <= NEIGHBOURS; ++i) sums.squares[i] = (lanes_f)(0.0f);
    return sums;
}

static inline void clear_gradient_sums(GradientSums* sums, lanes_mask wanted) {
    const Vec zero = vec_of((float4)(0.0f));
    for (uint i = 0; i < NEIGHBOURS; ++i) sums->sum.toward[i] = vec_select(sums->sum.toward[i], zero, wanted);
    for (uint i = 0; i <= NEIGHBOURS; ++i) sums->squares[i] = lanes_select(sums->squares[i], (lanes_f)(0.0f), wanted);
}

static inline lanes_f squared_mean(Vec a) {
    const lanes_f mean = (a.x + a.y + a.z) * (1.0f / 3.0f);
    return mean * mean;
}

/* Adds a sample to each of these lanes' units. */
static inline void add_gradients(GradientSums* sums, const Gradients* sample, Vec radiance, lanes_mask ended) {
    const Vec zero = vec_of((float4)(0.0f));
    for (uint i = 0; i < NEIGHBOURS; ++i) {
        const Vec added = vec_select(zero, sample->toward[i], ended);
        sums->sum.toward[i] = vec_add_scaled(sums->sum.toward[i], added, (lanes_f)(1.0f));
        sums->squares[i] += squared_mean(added);
    }
    sums->squares[NEIGHBOURS] += squared_mean(vec_select(zero, radiance, ended));
}

/* A pixel has the difference to its right neighbour and to the one below; that to its left neighbour is the latter's. */
static inline lanes_u gradient_place(const Picture* picture, lanes_u place, uint neighbour) {
    return place - (neighbour == 1u ? 1u : neighbour == 3u ? (uint)picture->width : 0u);
}

/* The lanes whose pixel, of this place, has that neighbour. */
static inline lanes_mask has_neighbour(const Picture* picture, lanes_u place, uint neighbour) {
    const uint width = (uint)picture->width, pixels = width * (uint)picture->height;
    const lanes_u pixel = place - lanes_select_u((lanes_u)(0u), (lanes_u)(pixels), place >= pixels);
    if (neighbour == 3u) return pixel >= width;
    if (neighbour == 2u) return pixel < pixels - width;
    const lanes_u column = pixel - lanes_divide(pixel, width, picture->inverse_width) * width;
    return neighbour == 0u ? column + 1u < width : column > 0u;
}

/* Adds numbers, and the square that belongs to them, to one kind of sums: 0 radiance, 1 across, 2 down. */
static inline void add_to_gradients(const Picture* picture, uint kind, lanes_u place, Vec added, lanes_f squares,
                                    lanes_mask wanted COUNTED_PARAMETER) {
    COUNTED_LANES(wanted, ENGINE_GRADIENT_WORK)
    const Vec scaled = vec_scale(added, (lanes_f)(picture->scale));
    const lanes_f scaled_squares = squares * picture->squares_scale;
    const Vec size = vec(lanes_abs(scaled.x), lanes_abs(scaled.y), lanes_abs(scaled.z));
    const lanes_mask fits =
        (size.x < FILM_FAR) & (size.y < FILM_FAR) & (size.z < FILM_FAR) & (scaled_squares < FILM_FAR);
    const float *red = (const float*)&scaled.x, *green = (const float*)&scaled.y, *blue = (const float*)&scaled.z;
    const float* square = (const float*)&scaled_squares;
    const uint* number = (const uint*)&place;
    for (uint left = lanes_bits(wanted & fits); left != 0u; left &= left - 1u) {
        const uint lane = lowest_bit(left);
        __global GradientPixel* pixel = picture->gradients + number[lane];
        __global long* sums = pixel->radiance + 3u * kind;
        splat_add(&sums[0], (long)red[lane]);
        splat_add(&sums[1], (long)green[lane]);
        splat_add(&sums[2], (long)blue[lane]);
        splat_add(&pixel->squares[kind], (long)square[lane]);
    }
    for (uint left = lanes_bits(wanted & !fits); left != 0u; left &= left - 1u) {
        const uint pixel = number[lowest_bit(left)], pixels = (uint)picture->width * (uint)picture->height;
        (void)atomic_inc((volatile __global uint*)&picture->splats[pixel % pixels].broken);
    }
}

/* Adds how much more a neighbour has. */
static inline void add_gradient(const Picture* picture, uint neighbour, lanes_u place, Vec more, lanes_f squares,
                                lanes_mask wanted COUNTED_PARAMETER) {
    const lanes_mask there = wanted & has_neighbour(picture, place, neighbour);
    COUNTED_LANES(wanted, ENGINE_NEIGHBOUR_WORK(neighbour))
    if (!lanes_any(there)) return;
    COUNTED_LANES(there, ENGINE_TOWARD_WORK)
    const lanes_f sign = (lanes_f)((neighbour & 1u) == 0u ? 1.0f : -1.0f);
    add_to_gradients(picture, neighbour < 2u ? 1u : 2u, gradient_place(picture, place, neighbour), vec_scale(more, sign),
                     squares, there COUNTED_ARGUMENT);
}

static inline void write_gradients(const Picture* picture, const Unit* unit, const GradientSums* sums, lanes_mask finished COUNTED_PARAMETER) {
    add_to_gradients(picture, 0u, unit->place, unit->sum, sums->squares[NEIGHBOURS], finished COUNTED_ARGUMENT);
    for (uint i = 0; i < NEIGHBOURS; ++i)
        add_gradient(picture, i, unit->place, sums->sum.toward[i], sums->squares[i], finished COUNTED_ARGUMENT);
}

#endif
