/* What a ray meets, be it a sphere or a triangle. */
#ifndef PTB_SCENE_MEET_H
#define PTB_SCENE_MEET_H

#include "scene/hit.h"
#include "scene/work.h"

#ifdef SCENE_TREE
#include "scene/search.h"
#endif

#ifndef SCENE_TREE

ALWAYS_INLINE Hit nearest_hit(Scene scene, const Ray* ray, const Sides* inside COUNTED_PARAMETER) {
    COUNTED_UNUSED
    return nearest_sphere(scene, ray, inside);
}

/* Whether nothing is between a ray's origin and its target, the sphere of this outer face, which it meets at `distance`. */
ALWAYS_INLINE lanes_mask sees(Scene scene, const Ray* ray, const Sides* inside, lanes_f distance, lanes_u target COUNTED_PARAMETER) {
    COUNTED_UNUSED
    return sees_past_spheres(scene, ray, inside, distance, target);
}

static inline void move_to_hit(Ray* ray, const Hit* hit) { move_to_sphere(ray, hit); }

/* The way to where a ray is from the centre of the sphere that it is at; of a triangle its normal. */
static inline Vec from_centre(const Ray* ray, Vec centre) { return vec_sub(ray->origin, centre); }

/* What `sees` has as its target where a ray is that met this face, and to start another there. */
static inline lanes_u target_at(const Ray* ray, lanes_u face) {
    (void)ray;
    return face;
}
static inline void start_at(Ray* ray, lanes_u target) { (void)ray, (void)target; }

/* The rays that went through the surface that they are at, by their sides before. */
static inline lanes_mask has_passed(const Ray* ray, const Sides* before, const Sides* after) {
    (void)ray;
    return sides_differ(before, after);
}

/* The rays go through the faces that they are at. */
static inline void pass_through(Scene scene, Ray* ray, Sides* inside, const Hit* hit, lanes_f along,
                                lanes_mask through COUNTED_PARAMETER) {
    (void)ray, (void)along;
    COUNTED_UNUSED
    change_sides(scene, inside, hit_face(hit), through);
}

#else

/* Begins to look for the nearest triangle before the nearest sphere. */
static inline void begin_search(Scene scene, const Ray* ray, const Sides* inside, Hit* hit, Search* search,
                                SearchStack* stack COUNTED_PARAMETER) {
    *hit = nearest_sphere(scene, ray, inside);
    search_begin(scene.tree, search, stack, ray->origin, ray->direction, hit_distance(hit), ray->left, TREE_NOTHING COUNTED_ARGUMENT);
}

/* Takes what the search found into the hit. The point is made of the corners, and kept a hair from the plane on the ray's
   side: so no neighbour in the same plane is met from behind. */
static inline void end_search(Scene scene, const Ray* ray, const Search* search, Hit* hit COUNTED_PARAMETER) {
    hit->triangle = TREE_NOTHING;
    const Found found = search->found;
    COUNTED_SEARCH
    if (found.place == TREE_NOTHING) {
#ifndef SCENE_NO_SPHERES
        COUNTED(1u, SCENE_MOVE_WORK)
        COUNTED(1u, SCENE_CENTRE_WORK)
#endif
        hit->point = hit->normal = vec_of((float4)(0.0f));
        hit->margin = 0.0f;
        return;
    }
    COUNTED(1u, TREE_MET_WORK)
    Vec corner[3];
    hit->triangle = triangle_at(scene.tree, found.place, corner);
    const float4 normal_face = scene.triangles[hit->triangle].normal_face;
    hit->normal = vec_of(normal_face);
    const bool inner = vec_dot(ray->direction, hit->normal) > 0.0f;
    hit->distance_bits = as_uint(found.distance);
    hit->number = as_uint(normal_face.w) + (inner ? 1u : 0u);
    hit->margin = triangle_margin(corner);
    const Vec b = vec_sub(corner[1], corner[0]), c = vec_sub(corner[2], corner[0]);
    const Vec point = vec_add_scaled(vec_add_scaled(corner[0], b, found.b), c, found.c);
    hit->point = vec_add_scaled(point, hit->normal, inner ? -hit->margin : hit->margin);
}

static inline Hit nearest_hit(Scene scene, const Ray* ray, const Sides* inside COUNTED_PARAMETER) {
    Hit hit;
    Search search;
    SearchStack stack;
    begin_search(scene, ray, inside, &hit, &search, &stack COUNTED_ARGUMENT);
    search_all(scene.tree, &search, &stack, false COUNTED_ARGUMENT);
    end_search(scene, ray, &search, &hit COUNTED_ARGUMENT);
    return hit;
}

static inline uint target_at(const Ray* ray, uint face) { return ray->left == TREE_NOTHING ? face : SCENE_TRIANGLE | ray->left; }
static inline uint triangle_of(uint target) { return (target & SCENE_TRIANGLE) != 0u ? target & ~SCENE_TRIANGLE : TREE_NOTHING; }
static inline void start_at(Ray* ray, uint target) { ray->left = triangle_of(target); }

/* Whether nothing but a triangle can be between. */
static inline bool may_see(Scene scene, const Ray* ray, const Sides* inside, float distance, uint target) {
    const uint end = triangle_of(target);
    const bool itself = end == ray->left && end != TREE_NOTHING;
    return !itself && sees_past_spheres(scene, ray, inside, distance, target);
}

static inline bool sees(Scene scene, const Ray* ray, const Sides* inside, float distance, uint target COUNTED_PARAMETER) {
    if (!may_see(scene, ray, inside, distance, target)) return false;
    Search search;
    SearchStack stack;
    COUNTED_SEARCH
    search_begin(scene.tree, &search, &stack, ray->origin, ray->direction, distance, ray->left, triangle_of(target) COUNTED_ARGUMENT);
    search_all(scene.tree, &search, &stack, true COUNTED_ARGUMENT);
    return search.found.place == TREE_NOTHING;
}

/* Rather than at a triangle. Of no use is where a ray is that has met nothing. */
static inline bool is_at_sphere(const Ray* ray) {
#ifdef SCENE_NO_SPHERES
    (void)ray;
    return false;
#else
    return ray->left == TREE_NOTHING;
#endif
}

static inline void move_to_hit(Ray* ray, const Hit* hit) {
    ray->left = hit->triangle;
    if (is_at_sphere(ray)) {
        move_to_sphere(ray, hit);
        return;
    }
    ray->origin = hit->point;
    ray->normal = hit->normal;
    ray->margin = hit->margin;
}

static inline Vec from_centre(const Ray* ray, Vec centre) {
    return is_at_sphere(ray) ? vec_sub(ray->origin, centre) : ray->normal;
}

static inline bool has_passed(const Ray* ray, const Sides* before, const Sides* after) {
    (void)before, (void)after;
    return ray->passed;
}

static inline void pass_through(Scene scene, Ray* ray, Sides* inside, const Hit* hit, float along, bool through COUNTED_PARAMETER) {
    ray->passed = through;
    if (is_at_sphere(ray)) {
        change_sides(scene, inside, hit_face(hit), through);
    } else if (through) {
        COUNTED(1u, TREE_PASS_WORK)
        ray->origin = vec_add_scaled(ray->origin, ray->normal, along > 0.0f ? 2.0f * ray->margin : -2.0f * ray->margin);
    }
}

#endif

/* A ray's way to its hit. With SCENE_PAUSES lanes of a warp that are there first go on to their next rays while the others
   search: scene/search.h. Else it is all done at the end. */
#ifdef SCENE_PAUSES

/* A ray that only asks whether it reaches its target; from where its path's next ray starts, and before that one. */
typedef struct ShadowRay {
    bool asked;
    Vec direction;
    float distance;
    uint target;
} ShadowRay;

typedef struct Meeting {
    Hit sphere;
    Search search;
    bool of_shadow_ray;
} Meeting;

typedef SearchStack MeetingStack;

/* Of the shadow ray, if it is asked. */
static inline Meeting begin_meeting(Scene scene, const Ray* ray, const Sides* inside, const ShadowRay* shadow,
                                    MeetingStack* stack COUNTED_PARAMETER) {
    Meeting meeting;
    meeting.of_shadow_ray = shadow->asked;
    if (!shadow->asked) meeting.sphere = nearest_sphere(scene, ray, inside);
    const Vec direction = shadow->asked ? shadow->direction : ray->direction;
    const float distance = shadow->asked ? shadow->distance : hit_distance(&meeting.sphere);
    const uint target = shadow->asked ? triangle_of(shadow->target) : TREE_NOTHING;
    search_begin(scene.tree, &meeting.search, stack, ray->origin, direction, distance, ray->left, target COUNTED_ARGUMENT);
    return meeting;
}

/* Whether it is at its end. */
static inline bool go_on(Scene scene, Meeting* meeting, MeetingStack* stack COUNTED_PARAMETER) {
    return search_some(scene.tree, &meeting->search, stack, meeting->of_shadow_ray COUNTED_ARGUMENT);
}

/* Whether a shadow ray reached its target. */
static inline bool has_seen(const Meeting* meeting COUNTED_PARAMETER) {
    COUNTED_UNUSED
    COUNTED_SEARCH
    return meeting->search.found.place == TREE_NOTHING;
}

/* Lanes that go on, and those that begin their next ray, meet again at the end of a turn: where no loop was between, NVIDIA's
   compiler sent those that go on ahead alone (H200, flake: 4064 -> 6017 Msegments/s). */
static inline uint meeting_here(void) { return warp_here(); }
static inline void meet_again(uint here) { warp_meets(here); }

static inline Hit end_meeting(Scene scene, const Ray* ray, const Sides* inside, const Meeting* meeting COUNTED_PARAMETER) {
    (void)inside;
    Hit hit = meeting->sphere;
    end_search(scene, ray, &meeting->search, &hit COUNTED_ARGUMENT);
    return hit;
}

#else

typedef struct Meeting {
    char none;
} Meeting;

typedef Meeting ShadowRay;
typedef Meeting MeetingStack;

static inline uint meeting_here(void) { return 0u; }
static inline void meet_again(uint here) { (void)here; }

static inline Meeting begin_meeting(Scene scene, const Ray* ray, const Sides* inside, const ShadowRay* shadow,
                                    MeetingStack* stack COUNTED_PARAMETER) {
    (void)scene, (void)ray, (void)inside, (void)shadow, (void)stack;
    COUNTED_UNUSED
    const Meeting meeting = {0};
    return meeting;
}

static inline bool go_on(Scene scene, Meeting* meeting, MeetingStack* stack COUNTED_PARAMETER) {
    (void)scene, (void)meeting, (void)stack;
    COUNTED_UNUSED
    return true;
}

ALWAYS_INLINE Hit end_meeting(Scene scene, const Ray* ray, const Sides* inside, const Meeting* meeting COUNTED_PARAMETER) {
    (void)meeting;
    return nearest_hit(scene, ray, inside COUNTED_ARGUMENT);
}

#endif
#endif
