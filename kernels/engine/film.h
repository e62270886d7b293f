/* The film: sums of whole numbers, a pixel each. */
#ifndef PTB_ENGINE_FILM_H
#define PTB_ENGINE_FILM_H

#include "engine/work.h"
#include "lib/strict.h"
#include "shared/engine.h"

#define FILM_FAR 0x1p62f /* sums stay below; see FILM_BROKEN */

/* Adds a tally's sum, in the film's unit, rounded. What is no number or too large shows in the picture as that. */
static inline long film_sum(long sum, float value, float scale) {
    const float scaled = value * scale;
    const bool fits = fabs(scaled) < FILM_FAR && sum < (long)FILM_FAR && sum > -(long)FILM_FAR;
    return fits ? sum + convert_long_rte(scaled) : FILM_BROKEN;
}

/* Adds the tallies of one launch to a pixel's sums. */
static inline void add_tallies(FilmPixel* sum, __global const Tally* tallies, uint pixel,
                               const EngineLaunch* launch COUNTED_PARAMETER) {
    for (uint unit = pixel; unit < launch->units; unit += launch->pixels) {
        const Tally tally = tallies[unit];
        const float radiance[3] = {tally.radiance.x, tally.radiance.y, tally.radiance.z};
        const float squares[3] = {tally.squares.x, tally.squares.y, tally.squares.z};
        for (uint c = 0; c < 3; ++c) {
            sum->radiance[c] = film_sum(sum->radiance[c], radiance[c], launch->radiance_scale);
            sum->squares[c] = film_sum(sum->squares[c], squares[c], launch->squares_scale);
        }
        sum->samples += tally.samples;
        sum->segments += tally.segments;
        sum->full_length_paths += tally.full_length_paths;
        sum->shadow_rays += tally.shadow_rays;
        COUNTED(1u, ENGINE_ADD_WORK)
    }
}

/* Pixels are moved as texels, 16 bytes at once: 1.02 of the whole at 10 SPP (H200). */
static inline FilmPixel film_unpack(uint4 first, uint4 second, uint4 third, uint4 counts) {
    const long2 a = as_long2(first), b = as_long2(second), c = as_long2(third);
    const FilmPixel sum = {{a.x, a.y, b.x}, {b.y, c.x, c.y}, counts.x, counts.y, counts.z, counts.w};
    return sum;
}

static inline void film_pack(const FilmPixel* sum, uint4 texels[FILM_LAYERS]) {
    texels[0] = as_uint4((long2)(sum->radiance[0], sum->radiance[1]));
    texels[1] = as_uint4((long2)(sum->radiance[2], sum->squares[0]));
    texels[2] = as_uint4((long2)(sum->squares[1], sum->squares[2]));
    texels[3] = (uint4)(sum->samples, sum->segments, sum->full_length_paths, sum->shadow_rays);
}

static inline FilmPixel film_load(__global const FilmPixel* place) {
    __global const uint4* texels = (__global const uint4*)place;
    return film_unpack(texels[0], texels[1], texels[2], texels[3]);
}

static inline void film_store(__global FilmPixel* place, const FilmPixel* sum) {
    uint4 texels[FILM_LAYERS];
    film_pack(sum, texels);
    for (uint i = 0; i < FILM_LAYERS; ++i) ((__global uint4*)place)[i] = texels[i];
}

#ifdef ENGINE_IMAGE_FILM

static inline FilmPixel film_load_texels(__read_only image2d_t film, int2 at, int rows) {
    const sampler_t nearest = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_NONE | CLK_FILTER_NEAREST;
    const int2 below = (int2)(0, rows);
    const uint4 first = read_imageui(film, nearest, at), second = read_imageui(film, nearest, at + below);
    const uint4 third = read_imageui(film, nearest, at + 2 * below), counts = read_imageui(film, nearest, at + 3 * below);
    return film_unpack(first, second, third, counts);
}

static inline void film_store_texels(__write_only image2d_t film, int2 at, int rows, const FilmPixel* sum) {
    uint4 texels[FILM_LAYERS];
    film_pack(sum, texels);
    for (int i = 0; i < FILM_LAYERS; ++i) write_imageui(film, at + i * (int2)(0, rows), texels[i]);
}

#endif
#endif
