/* What a sample adds to any pixel of the picture: where a point is seen in it, and sums of whole numbers by atomics. */
#ifndef PTB_ENGINE_SPLAT_H
#define PTB_ENGINE_SPLAT_H

#include "lib/bits.h"
#include "engine/film.h"
#include "engine/unit.h"

#if defined(cl_khr_int64_base_atomics) && !defined(ENGINE_SPLIT_ATOMICS)
#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable
static inline void splat_add(volatile __global long* sum, long value) { (void)atom_add(sum, value); }
#else
/* By halves, the lower first: the carry is told by what was there before, so it is added once whatever the order. */
static inline void splat_add(volatile __global long* sum, long value) {
    volatile __global uint* halves = (volatile __global uint*)sum;
    const uint low = (uint)value, before = atomic_add(&halves[0], low);
    const uint high = (uint)((ulong)value >> 32) + (before + low < before ? 1u : 0u);
    if (high != 0u) (void)atomic_add(&halves[1], high);
}
#endif

/* The picture, and what is added to it. */
typedef struct Picture {
    PtbPicture frame;
    float4 camera;       /* its position, as the device has it */
    float width, height; /* in pixels */
    float scale;         /* of the film */
    __global Splat* splats;
#ifdef ENGINE_GRADIENTS
    float squares_scale, inverse_width;
    __global GradientPixel* gradients; /* those of the first half of the samples, then of the second */
#endif
} Picture;

static inline Picture picture_of(const EngineLaunch* launch, float4 camera ENGINE_SPLATS_PARAMETER) {
    Picture picture;
    picture.frame = launch->picture;
    picture.camera = camera;
    picture.width = (float)launch->width;
    picture.height = (float)launch->height;
    picture.scale = launch->radiance_scale;
    picture.splats = splats;
#ifdef ENGINE_GRADIENTS
    picture.squares_scale = launch->squares_scale;
    picture.inverse_width = launch->inverse_width;
    picture.gradients = gradients;
#endif
    return picture;
}

/* 1 / density, by solid angle, of the directions that samples of the whole picture take; `cosine` is that with the axis. */
static inline lanes_f inverse_of_frame(const PtbPicture* frame, lanes_f cosine) {
    return cosine * cosine * cosine * frame->axis_area.w;
}
static inline lanes_f inverse_of_picture(const Picture* picture, lanes_f cosine) {
    return inverse_of_frame(&picture->frame, cosine);
}

/* The lanes whose direction, from the camera and of length 1, lies in the picture, and the pixel there. */
static inline lanes_mask pixel_of(const Picture* picture, Vec direction, lanes_f cosine, lanes_u* pixel) {
    const lanes_f inverse = 1.0f / cosine;
    const lanes_f x = vec_dot(direction, vec_of(picture->frame.across)) * inverse + picture->frame.across.w;
    const lanes_f y = vec_dot(direction, vec_of(picture->frame.down)) * inverse + picture->frame.down.w;
    const lanes_mask within =
        (cosine > 0.0f) & (x >= 0.0f) & (x < picture->width) & (y >= 0.0f) & (y < picture->height);
    const lanes_f zero = (lanes_f)(0.0f);
    const lanes_u row = lanes_to_u(lanes_select(zero, y, within));
    *pixel = row * (uint)picture->width + lanes_to_u(lanes_select(zero, x, within));
    return within;
}

/* Adds radiance to pixels of each lane's own. Scaled, cut and picked lane by lane from memory: 1.26 of the whole, by a loop over
   all lanes 1 (two AVX-512 cores, PoCL). */
static inline void splat(const Picture* picture, lanes_u pixel, Vec radiance, lanes_mask seen COUNTED_PARAMETER) {
    COUNTED_LANES(seen, ENGINE_SPLAT_WORK)
    const Vec scaled = vec_scale(radiance, (lanes_f)(picture->scale));
    const Vec size = vec(lanes_abs(scaled.x), lanes_abs(scaled.y), lanes_abs(scaled.z));
    const lanes_mask fits = (size.x < FILM_FAR) & (size.y < FILM_FAR) & (size.z < FILM_FAR);
    const float *red = (const float*)&scaled.x, *green = (const float*)&scaled.y, *blue = (const float*)&scaled.z;
    const uint* number = (const uint*)&pixel;
    const lanes_mask broken = seen & !fits;
    for (uint left = lanes_bits(seen & fits); left != 0u; left &= left - 1u) {
        const uint lane = lowest_bit(left);
        __global Splat* place = picture->splats + number[lane];
        splat_add(&place->radiance[0], (long)red[lane]);
        splat_add(&place->radiance[1], (long)green[lane]);
        splat_add(&place->radiance[2], (long)blue[lane]);
    }
    if (!lanes_any(broken)) return;
    for (uint left = lanes_bits(broken); left != 0u; left &= left - 1u)
        (void)atomic_inc((volatile __global uint*)&picture->splats[number[lowest_bit(left)]].broken);
}

/* Rays of light paths go to the pixels of the units that they belong to; `own_shadow_rays`: no tally has those. */
static inline void add_light_rays(const Picture* picture, const Unit* unit, Traced now, lanes_mask finished,
                                  bool own_shadow_rays, const EngineLaunch* launch) {
    const Traced traced = traced_since(&now, &unit->before);
    for (uint lane = 0; lane < PTB_LANES; ++lane) {
        if (!LANE(finished, lane)) continue;
        const uint pixel = launch->first_pixel + LANE(unit->number, lane) % launch->pixels;
        volatile __global Splat* place = picture->splats + pixel;
        (void)atomic_add(&place->light_segments, LANE(traced.light_segments, lane));
        if (own_shadow_rays) (void)atomic_add(&place->shadow_rays, LANE(traced.shadow_rays, lane));
    }
}

#endif
