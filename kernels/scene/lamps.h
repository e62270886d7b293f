/* Next-event estimation: a direction towards a lamp, and how likely it is. A lamp is a sphere that shines and that paths
   meet from outside. */
#ifndef PTB_SCENE_LAMPS_H
#define PTB_SCENE_LAMPS_H

#include "lib/sphere_direction.h"
#include "scene/surface.h"
#include "scene/work.h"

#define PI 3.14159265f

/* Of each lane its own lamp; see SceneLamp. */
typedef struct Lamp {
    Vec centre, axis, radiance;
    lanes_f radius, extent, chance, cap_density, near_squared;
    lanes_u face;
#ifdef SCENE_TREE
    uint place;
#endif
} Lamp;

/* The lamps of a scene: the first by value, as few spheres are, the others in memory. */
typedef struct Lamps {
    const SceneLamp* first;
    __global const SceneLamp* rows;
    uint count;
} Lamps;

#ifdef SCENE_LONE_LAMP

#define LAMP_FLOAT(lamps, number, member) ((lanes_f)((lamps)->first->member))
#define LAMP_UINT(lamps, number, member) ((lanes_u)((lamps)->first->member))
ALWAYS_INLINE lanes_u choose_lamp(const Lamps* lamps, lanes_u word, lanes_u share) {
    (void)lamps, (void)word, (void)share;
    return (lanes_u)(0u);
}

#else

#define LAMP_FLOAT(lamps, number, member) LANES_GATHER(float, (lamps)->rows, number, .member)
#define LAMP_UINT(lamps, number, member) LANES_GATHER(uint, (lamps)->rows, number, .member)
/* By power, in a time that does not depend on their number: see SceneLamp. */
ALWAYS_INLINE lanes_u choose_lamp(const Lamps* lamps, lanes_u word, lanes_u share) {
    const lanes_f place = (random_1_2(word) - 1.0f) * (float)lamps->count;
    const lanes_u number = lanes_min_u(lanes_to_u(place), (lanes_u)(lamps->count - 1u));
    const lanes_mask stays = random_1_2(share) - 1.0f < LAMP_FLOAT(lamps, number, radiance_kept.w);
    return lanes_select_u(LAMP_UINT(lamps, number, alias), number, stays);
}

#endif

#if PTB_LANES == 1
/* By whole vectors, as memory is read. */
ALWAYS_INLINE Lamp lamp_of(const Lamps* lamps, lanes_u number) {
#ifdef SCENE_LONE_LAMP
    const SceneLamp* row = lamps->first;
    (void)number;
#else
    __global const SceneLamp* row = &lamps->rows[number];
#endif
    const float4 centre_radius = row->centre_radius, axis_extent = row->axis_extent, radiance = row->radiance_kept;
    const Lamp lamp = {vec_of(centre_radius), vec_of(axis_extent), vec_of(radiance), centre_radius.w, axis_extent.w,
                       row->chance, row->cap_density, row->near_squared, row->face
#ifdef SCENE_TREE
                       , row->place
#endif
    };
    return lamp;
}
#else
ALWAYS_INLINE Lamp lamp_of(const Lamps* lamps, lanes_u number) {
    (void)number;
    Lamp lamp;
    lamp.centre.x = LAMP_FLOAT(lamps, number, centre_radius.x);
    lamp.centre.y = LAMP_FLOAT(lamps, number, centre_radius.y);
    lamp.centre.z = LAMP_FLOAT(lamps, number, centre_radius.z);
    lamp.radius = LAMP_FLOAT(lamps, number, centre_radius.w);
    lamp.axis.x = LAMP_FLOAT(lamps, number, axis_extent.x);
    lamp.axis.y = LAMP_FLOAT(lamps, number, axis_extent.y);
    lamp.axis.z = LAMP_FLOAT(lamps, number, axis_extent.z);
    lamp.extent = LAMP_FLOAT(lamps, number, axis_extent.w);
    lamp.radiance.x = LAMP_FLOAT(lamps, number, radiance_kept.x);
    lamp.radiance.y = LAMP_FLOAT(lamps, number, radiance_kept.y);
    lamp.radiance.z = LAMP_FLOAT(lamps, number, radiance_kept.z);
    lamp.chance = LAMP_FLOAT(lamps, number, chance);
    lamp.cap_density = LAMP_FLOAT(lamps, number, cap_density);
    lamp.near_squared = LAMP_FLOAT(lamps, number, near_squared);
    lamp.face = LAMP_UINT(lamps, number, face);
    return lamp;
}
#endif

/* The density by area with which paths start at a point of a lamp: a triangle's area is that of both sides. */
#ifdef SCENE_TREE
static inline bool is_triangle(const Lamp* lamp) { return (lamp->face & SCENE_TRIANGLE) != 0u; }
static inline float area_density_of(const Lamp* lamp) { return is_triangle(lamp) ? 0.5f * lamp->cap_density : lamp->cap_density; }
#else
static inline lanes_f area_density_of(const Lamp* lamp) { return lamp->cap_density; }
#endif

/* Of a number from 1 to 2, say 1 / x: cheaper than a division where roots are estimated. */
static inline lanes_f inverse_by_root(lanes_f x) {
    const lanes_f root = lanes_rsqrt(x);
    return root * root;
}

/* A unit vector in the frame that has `axis` as its third: see "Building an Orthonormal Basis, Revisited", by Duff et al. */
static inline Vec from_frame(Vec axis, lanes_f x, lanes_f y, lanes_f z) {
    const lanes_f sign = lanes_select((lanes_f)(-1.0f), (lanes_f)(1.0f), axis.z >= 0.0f);
    const lanes_f a = -sign * inverse_by_root(lanes_abs(sign + axis.z));
    const lanes_f b = axis.x * axis.y * a;
    const Vec first = vec(1.0f + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
    const Vec second = vec(b, sign + axis.y * axis.y * a, -axis.y);
    return vec_add_scaled(vec_add_scaled(vec_scale(first, x), second, y), axis, z);
}

/* A uniform direction of those whose cosine with `axis` is at most `extent` below 1. */
static inline Vec uniform_cone(Vec axis, lanes_f extent, lanes_u u, lanes_u v) {
    const lanes_f down = (random_1_2(u) - 1.0f) * extent;
    lanes_f x, y;
    turned_sincos(random_1_2(v), lanes_sqrt(down * (2.0f - down)), &y, &x);
    return from_frame(axis, x, y, 1.0f - down);
}

/* A point of what shows of a lamp, uniform by area, as its unit normal. A lamp that hangs free is a cap of all the sphere. */
static inline Vec point_of_lamp(const Lamp* lamp, lanes_u u, lanes_u v) { return uniform_cone(lamp->axis, lamp->extent, u, v); }

/* How a point samples a lamp. Near it, and always one that hangs free, it takes the sphere as it sees it, uniformly by solid
   angle: the cone `axis`, `extent`. Of one sunk in an opaque sphere it else takes the cap that shows, by area. */
typedef struct Sight {
    Vec to_centre, axis; /* the latter has length 1 */
    lanes_f extent;
    lanes_mask near;
} Sight;

#if defined(SCENE_LONE_LAMP) && SCENE_LONE_LAMP == SCENE_FREE_LAMP
#define LAMPS_HAVE_CAPS 0
#else
#define LAMPS_HAVE_CAPS 1
#endif

ALWAYS_INLINE Sight sight_of(const Lamp* lamp, Vec point, lanes_mask counts COUNTED_PARAMETER) {
    (void)counts;
    Sight sight;
    COUNTED_LANES(counts, LAMP_SIGHT_WORK)
    sight.to_centre = vec_sub(lamp->centre, point);
    const lanes_f squared = vec_dot(sight.to_centre, sight.to_centre);
    sight.axis = lamp->axis;
    sight.extent = lamp->extent;
    sight.near = LAMPS_HAVE_CAPS ? squared < lamp->near_squared : lanes_all();
    if (lanes_any(sight.near)) {
        COUNTED_LANES(counts & sight.near, LAMP_NEAR_WORK)
        const lanes_f inverse = lanes_rsqrt(squared), sine = lamp->radius * inverse;
        sight.axis = vec_scale(sight.to_centre, inverse);
        /* of a point that rounding put into the lamp: half of all directions */
        const lanes_f squared_sine = lanes_min(sine * sine, (lanes_f)(1.0f));
        sight.extent = squared_sine * inverse_by_root(1.0f + lanes_sqrt(1.0f - squared_sine));
    }
    return sight;
}

/* A density by solid angle is part / whole: so neither is divided by what may be 0. */
typedef struct Density {
    lanes_f part, whole;
} Density;

static inline Density lamp_density(const Lamp* lamp, const Sight* sight, lanes_f squared_distance, lanes_f cosine) {
    const Density density = {
        lanes_select(lamp->cap_density * squared_distance, lamp->chance * (0.5f / PI), sight->near),
        lanes_select(cosine, sight->extent, sight->near)};
    return density;
}

/* A direction towards a lamp, and how far the lamp is there. */
typedef struct LampSample {
    Vec direction, radiance;
    lanes_f distance, area_density; /* see area_density_of */
    Density density;
    lanes_u face;
} LampSample;

/* What is random in it, for all lanes: a lane's numbers do not depend on what others meet. */
typedef struct LampDraw {
    lanes_u u, v, choice, share;
} LampDraw;

static inline LampDraw draw_lamp(Random* random) {
    LampDraw draw;
    random_next_two(random, &draw.u, &draw.v);
#ifdef SCENE_LONE_LAMP
    draw.choice = draw.share = (lanes_u)(0u);
#else
    random_next_two(random, &draw.choice, &draw.share);
#endif
    return draw;
}

#ifdef SCENE_TREE
/* A uniform point of a triangle whose first corner is seen as `first`, see "Graphics Gems: Generating Random Points in Triangles",
   by G. Turk. */
static inline Vec point_of_triangle(const Vec corner[3], Vec first, uint u, uint v) {
    const float away = lanes_sqrt(random_1_2(u) - 1.0f), share_c = away * (random_1_2(v) - 1.0f);
    const Vec b = vec_sub(corner[1], corner[0]), c = vec_sub(corner[2], corner[0]);
    return vec_add_scaled(vec_add_scaled(first, b, away - share_c), c, share_c);
}

/* How likely the way over a distance in this direction, which ends at a triangle that shines, is asked for. */
static inline Density density_of_triangle(float density_by_area, Vec direction, float distance, Vec normal) {
    const Density density = {density_by_area * distance * distance, fabs(vec_dot(direction, normal))};
    return density;
}

static inline LampSample sample_triangle(Scene scene, const Lamp* lamp, Vec point, const LampDraw* draw COUNTED_PARAMETER) {
    COUNTED(1u, LAMP_TRIANGLE_WORK)
    Vec corner[3];
    const uint number = triangle_at(scene.tree, lamp->place, corner);
    const Vec to_lamp = point_of_triangle(corner, vec_sub(corner[0], point), draw->u, draw->v);
    const float squared = vec_dot(to_lamp, to_lamp), inverse = lanes_rsqrt(squared);
    LampSample sample;
    sample.direction = vec_scale(to_lamp, inverse);
    sample.radiance = lamp->radiance;
    sample.distance = squared * inverse;
    sample.area_density = area_density_of(lamp);
    sample.density.part = lamp->cap_density * squared;
    sample.density.whole = fabs(vec_dot(sample.direction, vec_of(scene.triangles[number].normal_face)));
    sample.face = lamp->face;
    return sample;
}

/* Puts a ray on a side of a triangle, drawn by a bit that no point is; returns the normal there. */
static inline Vec start_on_triangle(Scene scene, const Lamp* lamp, const LampDraw* draw, Ray* ray COUNTED_PARAMETER) {
    COUNTED(1u, LAMP_SIDE_WORK)
    Vec corner[3];
    (void)triangle_at(scene.tree, lamp->place, corner);
    const Vec normal = vec_scale(lamp->axis, (int)draw->u < 0 ? -1.0f : 1.0f);
    ray->origin = vec_add_scaled(point_of_triangle(corner, corner[0], draw->u << 1, draw->v), normal, triangle_margin(corner));
    return normal;
}
#endif

/* Puts rays at points of lamps, uniform by area, of triangles on either side; returns the unit normals there. */
ALWAYS_INLINE Vec start_on_lamp(Scene scene, const Lamp* lamp, const LampDraw* draw, Ray* ray, lanes_mask counts COUNTED_PARAMETER) {
    (void)scene, (void)counts;
    start_at(ray, lamp->face);
#ifdef SCENE_TREE
    if (is_triangle(lamp)) return start_on_triangle(scene, lamp, draw, ray COUNTED_ARGUMENT);
#endif
    COUNTED_LANES(counts, LAMP_POINT_WORK)
    const Vec normal = point_of_lamp(lamp, draw->u, draw->v);
    ray->origin = vec_add_scaled(lamp->centre, normal, lamp->radius);
    return normal;
}

ALWAYS_INLINE LampSample sample_lamp(Scene scene, const Lamps* lamps, Vec point, const LampDraw* draw,
                                     lanes_mask counts COUNTED_PARAMETER) {
    (void)scene;
#ifndef SCENE_LONE_LAMP
    COUNTED_LANES(counts, LAMP_CHOICE_WORK)
#endif
    const lanes_u number = choose_lamp(lamps, draw->choice, draw->share);
    const Lamp lamp = lamp_of(lamps, number);
#ifdef SCENE_TREE
    if (is_triangle(&lamp)) return sample_triangle(scene, &lamp, point, draw COUNTED_ARGUMENT);
#endif
    const Sight sight = sight_of(&lamp, point, counts COUNTED_ARGUMENT);
    LampSample sample;
    sample.radiance = lamp.radiance;
    sample.face = lamp.face;
    sample.area_density = area_density_of(&lamp);
    lanes_f squared = (lanes_f)(0.0f), cosine = squared;
    if (LAMPS_HAVE_CAPS) {
        COUNTED_LANES(counts, LAMP_CAP_WORK)
        const Vec outwards = point_of_lamp(&lamp, draw->u, draw->v);
        const Vec to_cap = vec_add_scaled(sight.to_centre, outwards, lamp.radius);
        squared = vec_dot(to_cap, to_cap);
        const lanes_f inverse = lanes_rsqrt(squared);
        sample.direction = vec_scale(to_cap, inverse);
        sample.distance = squared * inverse;
        cosine = -vec_dot(sample.direction, outwards);
    }
    if (lanes_any(sight.near)) {
        COUNTED_LANES(counts & sight.near, LAMP_DIRECTION_WORK)
        const Vec direction = uniform_cone(sight.axis, sight.extent, draw->u, draw->v);
        const lanes_f middle = vec_dot(direction, sight.to_centre);
        const Vec aside = vec_add_scaled(sight.to_centre, direction, -middle);
        const lanes_f half_chord = lanes_sqrt(lanes_max(lamp.radius * lamp.radius - vec_dot(aside, aside), (lanes_f)(0.0f)));
        sample.direction = LAMPS_HAVE_CAPS ? vec_select(sample.direction, direction, sight.near) : direction;
        sample.distance =
            LAMPS_HAVE_CAPS ? lanes_select(sample.distance, middle - half_chord, sight.near) : middle - half_chord;
    }
    COUNTED_LANES(counts, LAMP_DENSITY_WORK)
    sample.density = lamp_density(&lamp, &sight, squared, cosine);
    return sample;
}

/* The density with which sample_lamp takes the way that a path went, from `ray` over `distance` to a lamp. */
ALWAYS_INLINE Density density_of_way(const Lamp* lamp, const Ray* ray, lanes_f distance, lanes_mask counts COUNTED_PARAMETER) {
#ifdef SCENE_TREE
    if (is_triangle(lamp)) {
        COUNTED(1u, LAMP_FLAT_WORK)
        return density_of_triangle(lamp->cap_density, ray->direction, distance, lamp->axis);
    }
#endif
    const Sight sight = sight_of(lamp, ray->origin, counts COUNTED_ARGUMENT);
    COUNTED_LANES(counts, LAMP_WAY_WORK)
    COUNTED_LANES(counts, LAMP_DENSITY_WORK)
    /* part and whole of a cap times its radius */
    const lanes_f beyond = vec_dot(ray->direction, sight.to_centre) - distance;
    return lamp_density(lamp, &sight, distance * distance * lamp->radius, lanes_max(beyond, (lanes_f)(0.0f)));
}

#endif
