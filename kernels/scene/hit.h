/* Where a ray meets spheres. */
#ifndef PTB_SCENE_HIT_H
#define PTB_SCENE_HIT_H

#include "scene/scene.h"

/* The nearest face so far. Distances compare by their bits: those of a missed sphere (NaN) and of one behind
   (negative) are larger than any positive float's as unsigned numbers, so one comparison refuses all three. */
typedef struct Hit {
#ifdef SCENE_FEW
    lanes_u key; /* the distance with the face's number in its low bits, so one minimum finds both: 2^-20 of the
                    distance is lost, which no path notices */
#else
    lanes_u distance_bits, number;
#endif
#ifdef SCENE_CARRIED
    lanes_f half_linear[SCENE_FEW];
#endif
#ifdef SCENE_TREE
    uint triangle; /* met, or TREE_NOTHING */
    Vec point, normal;
    float margin; /* see Ray */
#endif
} Hit;

#define HIT_FAR 0x7f7ffff0u /* a large float, of low bits 0 */

#ifdef SCENE_FEW

#define HIT_NUMBER (~SCENE_DISTANCE_MASK)

static inline Hit no_hit(uint background) {
    Hit hit;
    hit.key = (lanes_u)(HIT_FAR | background);
    return hit;
}
static inline void hit_offer(Hit* hit, lanes_f distance, lanes_u face, uint distance_mask) {
    hit->key = lanes_min_u((lanes_as_u(distance) & distance_mask) | face, hit->key);
}
static inline lanes_f hit_distance(const Hit* hit) { return lanes_as_f(hit->key); }
static inline lanes_u hit_face(const Hit* hit) { return hit->key & HIT_NUMBER; }

#else

static inline Hit no_hit(uint background) {
    Hit hit;
    hit.distance_bits = (lanes_u)(HIT_FAR);
    hit.number = (lanes_u)(background);
    return hit;
}
static inline void hit_offer(Hit* hit, lanes_f distance, lanes_u face, uint distance_mask) {
    (void)distance_mask;
    const lanes_u bits = lanes_as_u(distance);
    hit->number = lanes_select_u(hit->number, face, bits < hit->distance_bits);
    hit->distance_bits = lanes_min_u(bits, hit->distance_bits);
}
static inline lanes_f hit_distance(const Hit* hit) { return lanes_as_f(hit->distance_bits); }
static inline lanes_u hit_face(const Hit* hit) { return hit->number; }

#endif

/* Few spheres all at once: their zeros are known then. Of more, two a turn: their arithmetic fills each other's waits. */
#ifdef SCENE_FEW
#define HIT_LOOP _Pragma("unroll")
#elif PTB_SIMD
#define HIT_LOOP _Pragma("clang loop unroll_count(2)")
#else
#define HIT_LOOP
#endif

/* A sphere is met at b -+ sqrt(b b + gap), with b = d.(c - o) and gap = r^2 - |o - c|^2. Computed like this, the gap of a
   large wall would be lost in rounding: |o - c|^2 has an ulp of 8 at a radius of 10 000. There are two ways around it.

   SCENE_CARRIED, for few spheres and one ray a work-item: a path carries every sphere's gap in a register. It starts as
   rounded from double on the host, and a move by t along d adds t (2 b - t).
   Otherwise gap = 2 o.c - o.o - k, where k = |c|^2 - r^2, rounded from double, and all terms are twenty times smaller.

   The host puts the origin where that errs least, and bounds the error (core/integrator/placement.h). Spheres for which it
   is too large lie together, SCENE_CAREFUL_BEGIN to SCENE_CAREFUL_END; no path carries gaps where there are any. Distant ones,
   so far from the origin for their size that the gap has no digits left, are SCENE_DISTANT_BEGIN to SCENE_DISTANT_END of these;
   the others are vast: their gap is right, but the distance drowns as the small difference of b and the root. */
#ifdef SCENE_CAREFUL_BEGIN
static inline bool is_distant(uint i) { return i - SCENE_DISTANT_BEGIN < SCENE_DISTANT_END - SCENE_DISTANT_BEGIN; }
static inline bool is_vast(uint i) { return i - SCENE_CAREFUL_BEGIN < SCENE_CAREFUL_END - SCENE_CAREFUL_BEGIN && !is_distant(i); }
#else
static inline bool is_distant(uint i) { return (void)i, false; }
static inline bool is_vast(uint i) { return (void)i, false; }
#endif

typedef struct Line {
    Vec direction;
    lanes_f minus_od;
#ifndef SCENE_CARRIED
    Vec twice_origin;
    lanes_f minus_oo;
#endif
} Line;

static inline Line line_of(const Ray* ray) {
    Line line;
    line.direction = ray->direction;
    line.minus_od = -vec_dot(ray->origin, ray->direction);
#ifndef SCENE_CARRIED
    line.twice_origin = vec_scale(ray->origin, (lanes_f)(2.0f));
    line.minus_oo = -vec_dot(ray->origin, ray->origin);
#endif
    return line;
}

/* Coordinates of centres that are 0, a bit a sphere: walls of a box mostly have two, and products with them cost nothing. */
#ifndef SCENE_ZERO_X
#define SCENE_ZERO_X 0u
#define SCENE_ZERO_Y 0u
#define SCENE_ZERO_Z 0u
#endif

/* centre.a + more, for sphere number i. */
static inline lanes_f dot_centre(float4 centre, uint i, Vec a, lanes_f more) {
    if ((SCENE_ZERO_Z >> i & 1u) == 0u) more = centre.z * a.z + more;
    if ((SCENE_ZERO_Y >> i & 1u) == 0u) more = centre.y * a.y + more;
    if ((SCENE_ZERO_X >> i & 1u) == 0u) more = centre.x * a.x + more;
    return more;
}

typedef struct Quadratic {
    lanes_f b, d, gap; /* distance = b -+ sqrt(d), and the product of both is -gap */
} Quadratic;

/* Of a distant sphere, whose w is radius^2: by way of the line's point nearest to the centre, see "Precision Improvements
   for Ray/Sphere Intersection", by E. Haines, J. Guenther and T. Akenine-Moeller. */
static inline Quadratic quadratic_of_distant(float4 centre_rr, const Ray* ray) {
    const Vec to_centre = vec_sub(vec_of(centre_rr), ray->origin);
    Quadratic e;
    e.b = vec_dot(to_centre, ray->direction);
    const Vec nearest = vec_add_scaled(to_centre, ray->direction, -e.b);
    e.d = centre_rr.w - vec_dot(nearest, nearest);
    e.gap = (lanes_f)(0.0f); /* asked of vast ones only */
    return e;
}

/* Of sphere number i. */
static inline Quadratic quadratic_of(float4 centre_k, uint i, const Line* line, const Ray* ray, Hit* hit) {
    if (is_distant(i)) return quadratic_of_distant(centre_k, ray);
    Quadratic e;
    e.b = dot_centre(centre_k, i, line->direction, line->minus_od);
#ifdef SCENE_CARRIED
    e.gap = ray->gap[i];
    hit->half_linear[i] = e.b;
#else
    (void)ray, (void)hit;
    e.gap = dot_centre(centre_k, i, line->twice_origin, line->minus_oo - centre_k.w);
#endif
    e.d = e.b * e.b + e.gap;
    return e;
}

/* b + root, a root of either sign. Of a vast sphere, where they cancel, by the product with the other distance. */
static inline lanes_f distance_by(Quadratic e, lanes_f root, uint i) {
    if (!is_vast(i)) return e.b + root;
    return lanes_select(e.b + root, e.gap / (root - e.b), e.b * root < 0.0f);
}

ALWAYS_INLINE void offer_opaque(Hit* hit, Scene scene, const Line* line, const Ray* ray) {
    HIT_LOOP
    for (uint i = 0; i < scene.opaque; ++i) {
        const Quadratic e = quadratic_of(scene.spheres[i].centre_k, i, line, ray, hit);
        const lanes_f root = i % 2u == 1u ? lanes_sqrt_beside(e.d) : lanes_sqrt(e.d);
        hit_offer(hit, distance_by(e, -root, i), (lanes_u)(opaque_face(scene, i)), scene.distance_mask);
    }
}

ALWAYS_INLINE void offer_two_sided(Hit* hit, Scene scene, const Line* line, const Ray* ray, const Sides* inside) {
    HIT_LOOP
    for (uint i = scene.opaque; i < scene.count; ++i) {
        const Quadratic e = quadratic_of(scene.spheres[i].centre_k, i, line, ray, hit);
        /* inside |d|, and the greater distance */
        const lanes_u side = side_of(scene, inside, i - scene.opaque), in = side_sign(scene, side);
        const lanes_f root = lanes_sqrt(lanes_as_f(lanes_as_u(e.d) & ~in));
        const lanes_f distance = distance_by(e, lanes_as_f(lanes_as_u(root) ^ in ^ LANES_SIGN), i);
        hit_offer(hit, distance, two_sided_face(scene, i - scene.opaque, side), scene.distance_mask);
    }
}

/* The nearest face ahead of each ray. No epsilon: a path knows on which side of every sphere it is, whatever rounding
   did to the ray's origin. From outside, a sphere is met at the near root, so a ray that leaves a sphere cannot meet it
   again (the root is negative); from inside it is always met, at the far root.
   On CPUs the two-sided spheres, which take longer, come first, and others' arithmetic fills the wait for the last:
   1.05 (two Zen 3 cores, PoCL); on GPUs last, 1.014 (H100). */
ALWAYS_INLINE Hit nearest_sphere(Scene scene, const Ray* ray, const Sides* inside) {
    const Line line = line_of(ray);
    Hit hit = no_hit(background(scene));
    if (PTB_LANES > 1) offer_two_sided(&hit, scene, &line, ray, inside);
    offer_opaque(&hit, scene, &line, ray);
    if (PTB_LANES == 1) offer_two_sided(&hit, scene, &line, ray, inside);
    return hit;
}

/* Whether sphere number i is met from outside before `distance`, or left from inside. No root is needed: those of
   t (t - 2 b) - gap are at b -+ sqrt(d). */
static inline lanes_mask meets_before(Quadratic e, lanes_f distance, uint i) {
    const lanes_f beyond = lanes_max(e.b - distance, (lanes_f)(0.0f));
    if (!is_vast(i)) return (e.b > 0.0f) & (e.d > beyond * beyond);
    const lanes_mask within = distance * (distance - 2.0f * e.b) < e.gap, behind = distance > e.b;
    return (e.b > 0.0f) & (e.d > 0.0f) & (within | behind);
}
static inline lanes_mask leaves_before(Quadratic e, lanes_f distance, uint i) {
    if (is_vast(i)) return distance * (distance - 2.0f * e.b) > e.gap;
    const lanes_f beyond = distance - e.b;
    return (beyond > 0.0f) & (beyond * beyond > e.d);
}

/* Whether no sphere is between a ray's origin and its target at `distance`: none but that of this outer face, if it is one,
   which is left out by its number (SEES_POINT: none is). No epsilon, as in nearest_sphere. */
#define SEES_POINT 0xffffffffu
ALWAYS_INLINE lanes_mask sees_past_spheres(Scene scene, const Ray* ray, const Sides* inside, lanes_f distance, lanes_u target) {
    const Line line = line_of(ray);
    Hit unused;
    lanes_mask blocked = lanes_none();
    HIT_LOOP
    for (uint i = 0; i < scene.opaque; ++i) {
        const Quadratic e = quadratic_of(scene.spheres[i].centre_k, i, &line, ray, &unused);
        const lanes_mask meets = meets_before(e, distance, i), other = target != opaque_face(scene, i);
        blocked |= meets & other;
    }
    HIT_LOOP
    for (uint i = scene.opaque; i < scene.count; ++i) {
        const Quadratic e = quadratic_of(scene.spheres[i].centre_k, i, &line, ray, &unused);
        const lanes_mask in = lanes_as_i(side_sign(scene, side_of(scene, inside, i - scene.opaque))) < 0;
        const lanes_mask meets = meets_before(e, distance, i), leaves = leaves_before(e, distance, i);
        const lanes_mask other = (target >> 1) != i - scene.opaque;
        blocked |= ((in & leaves) | (!in & meets)) & other;
    }
    return !blocked;
}

/* Moves the rays to their hits. */
static inline void move_to_sphere(Ray* ray, const Hit* hit) {
    const lanes_f t = hit_distance(hit);
    ray->origin = vec_add_scaled(ray->origin, ray->direction, t);
#ifdef SCENE_CARRIED
    for (uint i = 0; i < SCENE_FEW; ++i) ray->gap[i] += t * (2.0f * hit->half_linear[i] - t);
#endif
}

#endif
