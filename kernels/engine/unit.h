/* Units of work, and the samples that lanes take from them; the contract is EngineLaunch in shared/engine.h. */
#ifndef PTB_ENGINE_UNIT_H
#define PTB_ENGINE_UNIT_H

#include "engine/path.h"
#include "lib/outlined.h"
#include "shared/engine.h"
#ifdef ENGINE_GRADIENTS
#include "shared/gradients.h"
#endif

/* One lane a work-item keeps its loop in the kernel, unless it is alone on a CPU, as it is among triangles: ENGINE_ALONE. A
   function that reads local memory PoCL compiles to a crash (3.1). */
#if (PTB_LANES > 1 || defined(ENGINE_ALONE)) && SCENE_SPHERES != SCENE_IN_LOCAL && SCENE_SURFACES != SCENE_IN_LOCAL
#define ENGINE_OUTLINE OUTLINED
#define ENGINE_STAY_OUTLINED STAY_OUTLINED
#else
#define ENGINE_OUTLINE static inline
#define ENGINE_STAY_OUTLINED (void)0
#endif

#if defined(ENGINE_GRADIENTS)
#define ENGINE_SPLATS_PARAMETER , __global Splat *splats, __global GradientPixel *gradients
#define ENGINE_SPLATS_ARGUMENT , splats, gradients
#elif defined(ENGINE_SPLATS)
#define ENGINE_SPLATS_PARAMETER , __global Splat* splats
#define ENGINE_SPLATS_ARGUMENT , splats
#else
#define ENGINE_SPLATS_PARAMETER
#define ENGINE_SPLATS_ARGUMENT
#endif

/* Rays that each lane traced, ever. */
typedef struct Traced {
    lanes_u segments, shadow_rays;
#ifdef ENGINE_SPLATS
    lanes_u light_segments;
#endif
} Traced;

static inline Traced traced_nothing(void) {
    Traced traced;
    traced.segments = traced.shadow_rays = (lanes_u)(0u);
#ifdef ENGINE_SPLATS
    traced.light_segments = (lanes_u)(0u);
#endif
    return traced;
}

static inline Traced traced_since(const Traced* now, const Traced* then) {
    Traced traced;
    traced.segments = now->segments - then->segments;
    traced.shadow_rays = now->shadow_rays - then->shadow_rays;
#ifdef ENGINE_SPLATS
    traced.light_segments = now->light_segments - then->light_segments;
#endif
    return traced;
}

static inline Traced traced_select(const Traced* if_false, const Traced* if_true, lanes_mask mask) {
    Traced traced;
    traced.segments = lanes_select_u(if_false->segments, if_true->segments, mask);
    traced.shadow_rays = lanes_select_u(if_false->shadow_rays, if_true->shadow_rays, mask);
#ifdef ENGINE_SPLATS
    traced.light_segments = lanes_select_u(if_false->light_segments, if_true->light_segments, mask);
#endif
    return traced;
}

/* The unit each lane works on, and its sums so far. */
typedef struct Unit {
    lanes_u number;
    lanes_u pixel_hash;
    lanes_f column, row; /* of its pixel, less 1, since random numbers begin there */
    lanes_u sample, end; /* the next one to start, and the one after the last */
    lanes_u counts; /* its samples, and ENGINE_FULL_LENGTH times its paths of full length */
    lanes_u taken;  /* units so far, with ENGINE_BOUNDED */
#ifdef ENGINE_GRADIENTS
    lanes_u place; /* of its pixel and half among the gradients */
#endif
    Traced before; /* it */
    Vec sum, squares;
} Unit;

/* The next sample of a lane's unit, ready to start. A camera ray costs as much as half a bounce for however few lanes; so
   all lanes that lack one get theirs together, once a lane needs what it has not. */
typedef struct Spare {
    Vec direction;
    Random random;
    lanes_mask ready;
    Vec radiance; /* of the sample that ended when the last spare was started; not in the unit's sums yet */
} Spare;

static inline Unit no_unit(void) {
    const Vec zero = vec_of((float4)(0.0f));
    const lanes_f nowhere = (lanes_f)(0.0f);
    const lanes_u none = (lanes_u)(0u);
    Unit unit;
    unit.number = unit.pixel_hash = unit.sample = unit.end = unit.counts = unit.taken = none;
    unit.column = unit.row = nowhere;
    unit.before = traced_nothing();
    unit.sum = unit.squares = zero;
#ifdef ENGINE_GRADIENTS
    unit.place = none;
#endif
    return unit;
}

static inline Spare no_spare(void) {
    Spare spare;
    spare.direction = spare.radiance = vec_of((float4)(0.0f));
    spare.random = random_none();
    spare.ready = lanes_none();
    return spare;
}

/* Gives each wanting lane the next unit of the queue; returns the lanes that got one. */
static inline lanes_mask take_units(Unit* unit, Traced traced, lanes_mask wanting, volatile __global uint* queue,
                                    __global const uint* run_starts, const EngineLaunch* launch) {
    lanes_mask may = wanting;
#ifdef ENGINE_BOUNDED
    may &= unit->taken < launch->units_per_lane;
    unit->taken += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), may);
#endif
    lanes_u number = lanes_select_u((lanes_u)(0xffffffffu), (lanes_u)(0u), may);
    for (uint lane = 0; lane < PTB_LANES; ++lane) {
        if (LANE(number, lane) == 0u) LANE(number, lane) = launch->first_unit + atomic_inc(queue);
    }
    const lanes_mask found = wanting & (number < launch->units);
    number = lanes_select_u((lanes_u)(0u), number, found);
    const lanes_mask got = MASK_OF_MANY(found), wanted = MASK_OF_MANY(wanting);
    const lanes_u run = lanes_divide(number, launch->pixels, launch->inverse_pixels);
    const lanes_u pixel = number - run * launch->pixels + launch->first_pixel;
    const lanes_u row = lanes_divide(pixel, launch->width, launch->inverse_width);
    __global const uint* starts = run_starts + launch->first_run;
    const lanes_u first = LANES_GATHER(uint, starts, run, ), end = LANES_GATHER(uint, starts + 1, run, );
    unit->number = lanes_select_u(unit->number, number, got);
    unit->pixel_hash = lanes_select_u(unit->pixel_hash, random_of_pixel(pixel, launch->seed), got);
    unit->column = lanes_select(unit->column, lanes_to_f(pixel - row * launch->width) - 1.0f, got);
    unit->row = lanes_select(unit->row, lanes_to_f(row) - 1.0f, got);
    unit->sample = lanes_select_u(unit->sample, first, got);
    unit->end = lanes_select_u(unit->end, end, got);
    unit->counts = lanes_select_u(unit->counts, end - first, got);
#ifdef ENGINE_GRADIENTS
    const lanes_u half_of_samples = (run + launch->first_run) & 1u;
    unit->place = lanes_select_u(unit->place, pixel + half_of_samples * (launch->width * launch->height), got);
#endif
    unit->before = traced_select(&unit->before, &traced, got);
    const Vec zero = vec_of((float4)(0.0f));
    unit->sum = vec_select(unit->sum, zero, wanted);
    unit->squares = vec_select(unit->squares, zero, wanted);
    return found;
}

/* Adds a sample to each of these lanes' units. */
static inline void add_samples(Unit* unit, Vec radiance, lanes_mask ended) {
    const Vec added = vec_select(vec_of((float4)(0.0f)), radiance, ended);
    unit->sum = vec(unit->sum.x + added.x, unit->sum.y + added.y, unit->sum.z + added.z);
    unit->squares = vec_mul_add(unit->squares, added, added);
}

static inline void write_units(const Unit* unit, Traced now, lanes_mask finished, __global Tally* tallies) {
    const Traced traced = traced_since(&now, &unit->before);
    for (uint lane = 0; lane < PTB_LANES; ++lane) {
        if (!LANE(finished, lane)) continue;
        Tally tally;
        tally.radiance = (float4)(LANE(unit->sum.x, lane), LANE(unit->sum.y, lane), LANE(unit->sum.z, lane), 0.0f);
        tally.squares =
            (float4)(LANE(unit->squares.x, lane), LANE(unit->squares.y, lane), LANE(unit->squares.z, lane), 0.0f);
        tally.samples = LANE(unit->counts, lane) % ENGINE_FULL_LENGTH;
        tally.segments = LANE(traced.segments, lane);
        tally.full_length_paths = LANE(unit->counts, lane) / ENGINE_FULL_LENGTH;
        tally.shadow_rays = LANE(traced.shadow_rays, lane);
        tallies[LANE(unit->number, lane)] = tally;
    }
}

/* Where in its pixel a sample lies, in pixels from its corner, plus 1; u and v are uniform in [1, 2). */
static inline void place_sample(lanes_u sample, lanes_f u, lanes_f v, const EngineLaunch* launch, lanes_f* x, lanes_f* y) {
#if defined(ENGINE_FILTER) && ENGINE_FILTER == ENGINE_CENTRE
    (void)sample, (void)u, (void)v, (void)launch;
    *x = *y = (lanes_f)(1.5f);
#elif defined(ENGINE_FILTER) && ENGINE_FILTER == ENGINE_STRATIFIED
    const lanes_u row = lanes_divide(sample, launch->strata_columns, launch->stratum_width);
    const lanes_u column = sample - row * launch->strata_columns;
    *x = (lanes_to_f(column) + (u - 1.0f)) * launch->stratum_width + 1.0f;
    *y = (lanes_to_f(row) + (v - 1.0f)) * launch->stratum_height + 1.0f;
#else
    (void)sample, (void)launch;
    *x = u;
    *y = v;
#endif
}

/* Gives every lane without a spare one, while its unit has samples to start: a camera ray through a point of its pixel. */
static inline void refill(Spare* spare, Unit* unit, const EngineLaunch* launch) {
    Random random = random_of_path(unit->pixel_hash, unit->sample);
    lanes_u u, v;
    random_next_two(&random, &u, &v);
    lanes_f x, y;
    place_sample(unit->sample, random_1_2(u), random_1_2(v), launch, &x, &y);
    const Vec across = vec_add_scaled(vec_of(launch->camera.corner), vec_of(launch->camera.step_x), unit->column + x);
    const Vec direction = vec_normalize(vec_add_scaled(across, vec_of(launch->camera.step_y), unit->row + y));
    const lanes_mask wanting = MASK_OF_MANY(!spare->ready & (unit->sample < unit->end));
    spare->direction = vec_select(spare->direction, direction, wanting);
    spare->random = random_select(spare->random, random, wanting);
    unit->sample += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), wanting);
    spare->ready = lanes_hold(spare->ready | wanting);
}

/* What all paths start with. */
typedef struct Start {
    SCENE_SURFACE_SPACE const SceneStart* row;
    __global const uint* sides; /* all words */
} Start;

static inline World world_of(SCENE_SPHERE_SPACE const SceneSphere* spheres, SCENE_SURFACE_SPACE const SceneSurface* surface_rows,
                             __global const SceneLamp* lamps, SCENE_TREE_PARAMETERS const EngineLaunch* launch) {
#ifdef SCENE_FEW
    const uint opaque = SCENE_OPAQUE, count = SCENE_FEW;
#elif defined(SCENE_NO_SPHERES)
    const uint opaque = 0u, count = 0u;
#else
    const uint opaque = launch->opaque_spheres, count = opaque + launch->two_sided_spheres;
#endif
    Scene scene = {spheres, opaque, count, 0u SCENE_TREE_MEMBERS};
    scene.distance_mask = ((SCENE_SURFACE_SPACE const SceneStart*)&surface_rows[background(scene) + 1u])->distance_mask;
    const World world = {scene, surfaces_of(surface_rows, background(scene)), {&launch->lamp, lamps, launch->lamps}, &launch->picture};
    return world;
}

static inline Start start_of(const World* world, SCENE_SURFACE_SPACE const SceneSurface* surface_rows,
                             __global const uint* camera_sides) {
    const Start start = {(SCENE_SURFACE_SPACE const SceneStart*)&surface_rows[background(world->scene) + 1u], camera_sides};
    return start;
}

/* Those of a camera ray. */
static inline Sides sides_of(Start start) {
    Sides sides;
    sides.word[0] = (lanes_u)(as_uint(start.row->position_side.w));
    for (uint i = 1; i < SCENE_SIDE_WORDS; ++i) sides.word[i] = (lanes_u)(start.sides[i]);
    return sides;
}
static inline Sides sides_select(const Sides* if_false, const Sides* if_true, lanes_mask mask) {
    Sides sides;
    for (uint i = 0; i < SCENE_SIDE_WORDS; ++i) sides.word[i] = lanes_select_u(if_false->word[i], if_true->word[i], mask);
    return sides;
}

/* Ends these paths and starts the lanes' spares in their place. */
static inline void start_spares(Path* path, Spare* spare, lanes_mask ended, uint turn,
                                Start start, const EngineLaunch* launch) {
    path->ray.origin = vec_select(path->ray.origin, vec_of(start.row->position_side), ended);
    path->ray.direction = vec_select(path->ray.direction, spare->direction, ended);
    path->throughput = vec_select(path->throughput, vec_of((float4)(1.0f)), ended);
#ifdef PATH_GATHERS
    path->radiance = vec_select(path->radiance, vec_of((float4)(0.0f)), ended);
    path->inverse_density = lanes_select(path->inverse_density, (lanes_f)(0.0f), ended);
#endif
#ifdef PATH_ODDS
    path->odds = lanes_select(path->odds, (lanes_f)(-1.0f), ended);
#endif
    path->random = random_select(path->random, spare->random, ended);
    path->last_turn = lanes_select_u(path->last_turn, (lanes_u)(turn + launch->path_length), ended);
    const Sides of_camera = sides_of(start);
    path->inside = sides_select(&path->inside, &of_camera, ended);
#ifdef SCENE_TREE
    if (ended) path->ray.left = TREE_NOTHING;
#endif
#ifdef SCENE_CARRIED
    for (uint i = 0; i < SCENE_FEW; ++i) {
        path->ray.gap[i] = lanes_select(path->ray.gap[i], (lanes_f)(start.row->gap[i]), ended);
    }
#endif
    spare->ready = lanes_hold(spare->ready & !ended);
}

#endif
