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

static inline FilmPixel film_load(__global const FilmPixel* place) {
    FilmPixel sum;
    for (uint c = 0; c < 3; ++c) {
        sum.radiance[c] = place->radiance[c];
        sum.squares[c] = place->squares[c];
    }
    sum.samples = place->samples;
    sum.segments = place->segments;
    sum.full_length_paths = place->full_length_paths;
    sum.shadow_rays = place->shadow_rays;
    return sum;
}

static inline void film_store(__global FilmPixel* place, const FilmPixel* sum) {
    for (uint c = 0; c < 3; ++c) {
        place->radiance[c] = sum->radiance[c];
        place->squares[c] = sum->squares[c];
    }
    place->samples = sum->samples;
    place->segments = sum->segments;
    place->full_length_paths = sum->full_length_paths;
    place->shadow_rays = sum->shadow_rays;
}

#ifdef __IMAGE_SUPPORT__

static inline FilmPixel film_load_texels(__read_only image2d_t film, int2 at, int rows) {
    const sampler_t nearest = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_NONE | CLK_FILTER_NEAREST;
    const int2 below = (int2)(0, rows);
    const long2 first = as_long2(read_imageui(film, nearest, at));
    const long2 second = as_long2(read_imageui(film, nearest, at + below));
    const long2 third = as_long2(read_imageui(film, nearest, at + 2 * below));
    const uint4 counts = read_imageui(film, nearest, at + 3 * below);
    const FilmPixel sum = {{first.x, first.y, second.x}, {second.y, third.x, third.y}, counts.x, counts.y, counts.z, counts.w};
    return sum;
}

static inline void film_store_texels(__write_only image2d_t film, int2 at, int rows, const FilmPixel* sum) {
    const int2 below = (int2)(0, rows);
    write_imageui(film, at, as_uint4((long2)(sum->radiance[0], sum->radiance[1])));
    write_imageui(film, at + below, as_uint4((long2)(sum->radiance[2], sum->squares[0])));
    write_imageui(film, at + 2 * below, as_uint4((long2)(sum->squares[1], sum->squares[2])));
    write_imageui(film, at + 3 * below, (uint4)(sum->samples, sum->segments, sum->full_length_paths, sum->shadow_rays));
}

#endif
#endif
