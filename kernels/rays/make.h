/* Makes rays as a path tracer would trace them, in scenes whose surfaces are all matte. What is random of a ray depends on its
   pixel, its sample and the seed alone, and where it starts is worked out from the triangle that was met, not from what the
   search found of it: so trees of all layouts are asked for the same rays, but where two triangles are met at once. */
#ifndef PTB_RAYS_MAKE_H
#define PTB_RAYS_MAKE_H

#include "lib/outlined.h"
#include "lib/random.h"
#include "lib/sphere_direction.h"
#include "scene/search.h"
#include "shared/rays.h"

#ifdef ENGINE_ALONE
#define RAYS_OUTLINE OUTLINED
#define RAYS_STAY_OUTLINED STAY_OUTLINED
#else
#define RAYS_OUTLINE static inline
#define RAYS_STAY_OUTLINED (void)0
#endif

/* A ray that finds no surface to start from is tried again, from another pixel. */
#define RAYS_TRIES 256u

#define RAYS_FAR 0x1.fffffep127f

/* Where a ray meets a surface, and the surface's normal on its side. */
typedef struct Ground {
    Vec point, normal;
    uint triangle;
} Ground;

static inline Vec vec_cross(Vec a, Vec b) {
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline ListedRay listed_ray(Vec origin, Vec direction, float reach, uint left) {
    ListedRay ray;
    ray.origin_left = (float4)(origin.x, origin.y, origin.z, as_float(left));
    ray.direction_reach = (float4)(direction.x, direction.y, direction.z, reach);
    return ray;
}

static inline ListedRay camera_ray(const RaysMaking* making, uint pixel, Random* random) {
    uint u, v;
    random_next_two(random, &u, &v);
    const float x = (float)(pixel % making->width) + (random_1_2(u) - 1.0f);
    const float y = (float)(pixel / making->width) + (random_1_2(v) - 1.0f);
    const Vec across = vec_add_scaled(vec_of(making->camera.corner), vec_of(making->camera.step_x), x);
    const Vec direction = vec_normalize(vec_add_scaled(across, vec_of(making->camera.step_y), y));
    return listed_ray(vec_of(making->camera.position), direction, RAYS_FAR, TREE_NOTHING);
}

/* The point lies a hair above the triangle, by which rounding may put it below. */
static inline Ground ground_on(Tree tree, uint place, const ListedRay* ray) {
    Vec corner[3];
    Ground ground;
    ground.triangle = triangle_at(tree, place, corner);
    const Vec origin = vec_of(ray->origin_left), direction = vec_of(ray->direction_reach);
    const Vec outwards = vec_normalize(vec_cross(vec_normalize(vec_sub(corner[1], corner[0])), vec_normalize(vec_sub(corner[2], corner[0]))));
    const float along = vec_dot(outwards, direction);
    const float distance = vec_dot(vec_sub(corner[0], origin), outwards) / along;
    ground.normal = vec_scale(outwards, along > 0.0f ? -1.0f : 1.0f);
    const float margin = triangle_margin(corner);
    ground.point = vec_add_scaled(vec_add_scaled(origin, direction, distance), ground.normal, margin);
    return ground;
}

/* It is not timed, so what it counts is dropped. */
static inline bool finds_ground(Tree tree, const ListedRay* ray, Ground* ground) {
    COUNTED_BEGIN
    Search search;
    SearchStack stack;
    search_begin(tree, &search, &stack, vec_of(ray->origin_left), vec_of(ray->direction_reach), ray->direction_reach.w,
                 as_uint(ray->origin_left.w), TREE_NOTHING COUNTED_ARGUMENT);
    search_all(tree, &search, &stack, false COUNTED_ARGUMENT);
    if (search.found.place == TREE_NOTHING) return false;
    *ground = ground_on(tree, search.found.place, ray);
    return true;
}

/* From the ground on, by the cosine. */
static inline ListedRay bounced(const Ground* ground, Random* random) {
    uint u, v;
    random_next_two(random, &u, &v);
    const Vec direction = vec_normalize(vec_add_scaled(uniform_sphere(u, v), ground->normal, 1.0f));
    return listed_ray(ground->point, direction, RAYS_FAR, ground->triangle);
}

/* From the ground to a point of a triangle that shines: any of them, uniformly by area. False where it shines on the back. */
static inline bool leads_to_lamp(__global const TreeTriangle* lamps, uint count, const Ground* ground, Random* random,
                                 ListedRay* ray) {
    uint u, v, w, unused;
    random_next_two(random, &u, &v);
    random_next_two(random, &w, &unused);
    const TreeTriangle lamp = lamps[min((uint)((random_1_2(u) - 1.0f) * (float)count), count - 1u)];
    const float root = lanes_sqrt(random_1_2(v) - 1.0f), share_c = root * (random_1_2(w) - 1.0f);
    const Vec a = vec_of(lamp.a_number), b = vec_sub(vec_of(lamp.b), a), c = vec_sub(vec_of(lamp.c), a);
    const Vec way = vec_sub(vec_add_scaled(vec_add_scaled(a, b, root - share_c), c, share_c), ground->point);
    if (as_uint(lamp.a_number.w) == ground->triangle || !(vec_dot(way, ground->normal) > 0.0f)) return false;
    const Vec direction = vec_normalize(way);
    *ray = listed_ray(ground->point, direction, RAYS_SHADOW_SHARE * vec_dot(way, direction), ground->triangle);
    return true;
}

/* From the camera over as many surfaces as are asked for. False where one of them is missing. */
static inline bool finds_ray(Tree tree, __global const TreeTriangle* lamps, const RaysMaking* making, uint pixel,
                             Random* random, ListedRay* ray) {
    *ray = camera_ray(making, pixel, random);
    for (uint i = 1u; i <= making->grounds; ++i) {
        Ground ground;
        if (!finds_ground(tree, ray, &ground)) return false;
        if (making->lamps > 0u && i == making->grounds) return leads_to_lamp(lamps, making->lamps, &ground, random, ray);
        *ray = bounced(&ground, random);
    }
    return true;
}

static inline bool find_ray(Tree tree, __global const TreeTriangle* lamps, const RaysMaking* making, uint number, ListedRay* ray) {
    uint pixel = number % making->pixels, unused;
    Random random = random_of_path(random_of_pixel(pixel, making->seed), number / making->pixels);
    for (uint i = 0u; i < RAYS_TRIES; ++i) {
        if (finds_ray(tree, lamps, making, pixel, &random, ray)) return true;
        random_next_two(&random, &pixel, &unused);
        pixel = mul_hi(pixel, making->pixels);
    }
    return false;
}

/* Makes the rays from number `first` to before `end`; returns how many it could not. */
RAYS_OUTLINE uint make_run(Tree tree, __global const TreeTriangle* lamps, __global ListedRay* rays, uint first, uint end,
                           RaysMaking making) {
    RAYS_STAY_OUTLINED;
    uint missing = 0u;
    for (uint i = first; i < end; ++i) {
        ListedRay ray;
        if (!find_ray(tree, lamps, &making, i, &ray)) ++missing;
        rays[i] = ray;
    }
    return missing;
}

#endif
