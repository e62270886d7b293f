/* Units of work and the paths that work them off; the contract is PtLaunch in shared/pt.h. */
#ifndef PTB_PT_UNIT_H
#define PTB_PT_UNIT_H

#include "lib/random.h"
#include "pt/scene.h"

typedef struct Path {
    Ray ray;
    Vec throughput;
    Vec radiance; /* gathered so far */
    Sides inside;
    Random random;
    lanes_u segments;
} Path;

/* The unit each lane works on, and its sums so far. */
typedef struct Unit {
    lanes_u number;
    lanes_u pixel;        /* of the whole image */
    lanes_u sample;       /* the next one to start */
    lanes_u samples_left; /* not ended yet */
    lanes_u samples;
    lanes_u taken; /* units so far */
    lanes_u segments, full_length_paths;
    Vec sum, squares;
} Unit;

static inline Unit no_unit(void) {
    const Vec zero = vec_of((float4)(0.0f));
    const lanes_u none = (lanes_u)(0u);
    const Unit unit = {none, none, none, none, none, none, none, none, zero, zero};
    return unit;
}

static inline Path no_path(void) {
    const Vec zero = vec_of((float4)(0.0f));
    const lanes_u none = (lanes_u)(0u);
    Path path;
    path.ray.origin = path.ray.direction = path.throughput = path.radiance = zero;
    path.random.a = path.random.b = path.segments = none;
    for (uint i = 0; i < PT_SIDE_WORDS; ++i) path.inside.word[i] = none;
    return path;
}

/* Gives each wanting lane the next unit of the queue; returns the lanes that got one. */
static inline lanes_mask take_units(Unit* unit, lanes_mask wanting, volatile __global uint* queue,
                                    const PtLaunch* launch) {
    lanes_u number = lanes_select_u(unit->number, (lanes_u)(0xffffffffu), wanting);
    const lanes_mask may = wanting & (unit->taken < launch->units_per_lane);
    for (uint lane = 0; lane < PTB_LANES; ++lane) {
        if (LANE(may, lane)) LANE(number, lane) = atomic_inc(queue);
    }
    unit->taken += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), may);
    const lanes_mask got = wanting & (number < launch->units);
    const lanes_u run = number / launch->pixels;
    const lanes_u first_sample = (run + launch->first_run) * launch->samples_per_unit;
    const lanes_u samples = min((lanes_u)(launch->samples_per_unit), launch->spp - first_sample);
    unit->number = number;
    unit->pixel = lanes_select_u(unit->pixel, number - run * launch->pixels + launch->first_pixel, wanting);
    unit->sample = lanes_select_u(unit->sample, first_sample, wanting);
    unit->samples = lanes_select_u(unit->samples, samples, wanting);
    unit->samples_left = lanes_select_u(unit->samples_left, samples, wanting);
    unit->segments = lanes_select_u(unit->segments, (lanes_u)(0u), wanting);
    unit->full_length_paths = lanes_select_u(unit->full_length_paths, (lanes_u)(0u), wanting);
    const Vec zero = vec_of((float4)(0.0f));
    unit->sum = vec_select(unit->sum, zero, wanting);
    unit->squares = vec_select(unit->squares, zero, wanting);
    return got;
}

/* Adds the ended paths to their units. */
static inline void add_samples(Unit* unit, const Path* path, lanes_mask ended, lanes_mask full) {
    const lanes_u one = (lanes_u)(1u), none = (lanes_u)(0u);
    const Vec radiance = vec_select(vec_of((float4)(0.0f)), path->radiance, ended);
    unit->sum = vec(unit->sum.x + radiance.x, unit->sum.y + radiance.y, unit->sum.z + radiance.z);
    unit->squares = vec_mul_add(unit->squares, radiance, radiance);
    unit->segments += lanes_select_u(none, path->segments, ended);
    unit->full_length_paths += lanes_select_u(none, one, ended & full);
    unit->samples_left -= lanes_select_u(none, one, ended);
}

static inline void write_units(const Unit* unit, lanes_mask finished, __global PtTally* tallies) {
    for (uint lane = 0; lane < PTB_LANES; ++lane) {
        if (!LANE(finished, lane)) continue;
        PtTally tally;
        tally.radiance = (float4)(LANE(unit->sum.x, lane), LANE(unit->sum.y, lane), LANE(unit->sum.z, lane), 0.0f);
        tally.squares =
            (float4)(LANE(unit->squares.x, lane), LANE(unit->squares.y, lane), LANE(unit->squares.z, lane), 0.0f);
        tally.samples = LANE(unit->samples, lane);
        tally.segments = LANE(unit->segments, lane);
        tally.full_length_paths = LANE(unit->full_length_paths, lane);
        tally.padding = 0u;
        tallies[LANE(unit->number, lane)] = tally;
    }
}

/* Starts the next sample of each starting lane's unit: a camera ray through a uniform point of its pixel. */
static inline void start_samples(Path* path, Unit* unit, lanes_mask starting, __global const uint* camera_sides,
                                 const PtLaunch* launch) {
    Random random = random_of_path(unit->pixel, unit->sample, launch->seed);
    const lanes_u row = unit->pixel / launch->width;
    const lanes_f x = lanes_to_f(lanes_as_i(unit->pixel - row * launch->width)) + random_next(&random);
    const lanes_f y = lanes_to_f(lanes_as_i(row)) + random_next(&random);
    const Vec across = vec_add_scaled(vec_of(launch->camera.corner), vec_of(launch->camera.step_x), x);
    const Vec direction = vec_normalize(vec_add_scaled(across, vec_of(launch->camera.step_y), y));
    path->ray.origin = vec_select(path->ray.origin, vec_of(launch->camera.position), starting);
    path->ray.direction = vec_select(path->ray.direction, direction, starting);
    path->throughput = vec_select(path->throughput, vec_of((float4)(1.0f)), starting);
    path->radiance = vec_select(path->radiance, vec_of((float4)(0.0f)), starting);
    path->random.a = lanes_select_u(path->random.a, random.a, starting);
    path->random.b = lanes_select_u(path->random.b, random.b, starting);
    path->segments = lanes_select_u(path->segments, (lanes_u)(0u), starting);
    for (uint i = 0; i < PT_SIDE_WORDS; ++i) {
        path->inside.word[i] = lanes_select_u(path->inside.word[i], (lanes_u)(camera_sides[i]), starting);
    }
    unit->sample += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), starting);
}

#endif
