/* What a path gathers of lamps: of one that it meets, and of one that it asks for on purpose. */
#ifndef PTB_ENGINE_LIGHT_H
#define PTB_ENGINE_LIGHT_H

#define PATH_GATHERS
#include "engine/path.h"
#include "engine/work.h"

/* What a path is worth that ended. */
static inline Vec gathered_radiance(const World* world, const Path* path, lanes_u face) {
    (void)world, (void)face;
    return path->radiance;
}

/* Adds the radiance of what the path met. */
static inline void gather_met(const World* world, Path* path, lanes_u face, lanes_f weight, lanes_mask counts COUNTED_PARAMETER) {
    (void)counts;
    COUNTED_LANES(counts, LIGHT_MET_WORK)
    const Vec radiance = vec_scale(radiance_of(&world->surfaces, face), weight);
    path->radiance = vec_mul_add(path->radiance, path->throughput, radiance);
}

/* The lanes whose face is one of a lamp that can be asked, and its number, which triangles' faces lack. */
static inline lanes_mask lamp_met(const World* world, lanes_u face, lanes_u* number) {
#ifdef SCENE_LONE_LAMP
    *number = (lanes_u)(0u);
    return face == world->lamps.first->face;
#else
    const lanes_u next = lamp_of_face(&world->surfaces, face);
    const lanes_mask is_lamp = next != 0u;
    *number = next - lanes_select_u((lanes_u)(0u), (lanes_u)(1u), is_lamp);
#ifdef SCENE_TREE
    return is_lamp || density_asked(&world->surfaces, face) > 0.0f;
#else
    return is_lamp;
#endif
#endif
}

/* The share of a way found by the path beside the density with which a lamp is asked for the same. */
static inline lanes_f share_beside(const Path* path, Density density) {
    const lanes_f whole = density.whole + 1e-30f; /* of a path that had no choice: 1, even at a cap's horizon */
    return whole / (whole + path->inverse_density * density.part);
}

/* A lamp that paths met, as others find it: by asking for this way, and by starting there. */
typedef struct LampMet {
    Density asked;
    lanes_f area_density;
} LampMet;

ALWAYS_INLINE LampMet lamp_at(const World* world, const Path* path, const Hit* hit, lanes_u number, lanes_mask counts COUNTED_PARAMETER) {
    const lanes_f distance = hit_distance(hit);
    LampMet met;
#ifdef SCENE_TREE
    if (hit->triangle != TREE_NOTHING) {
        COUNTED(1u, LIGHT_TRIANGLE_WORK)
        const float density = density_asked(&world->surfaces, hit_face(hit));
        met.asked = density_of_triangle(density, path->ray.direction, distance, hit->normal);
        met.area_density = 0.5f * density;
        return met;
    }
#endif
    const Lamp lamp = lamp_of(&world->lamps, number);
    met.asked = density_of_way(&lamp, &path->ray, distance, counts COUNTED_ARGUMENT);
    met.area_density = area_density_of(&lamp);
    return met;
}

#ifdef PATH_ODDS
/* What paths from lamps leave of a lamp that was met by mirrors and glass alone. */
static inline lanes_f share_beside_lights(const Path* path, lanes_f area_density, lanes_f share) {
    const lanes_f odds = lanes_max(path->odds, (lanes_f)(0.0f)) * area_density;
    return share / (1.0f + lanes_select(odds, (lanes_f)(0.0f), path->inverse_density > 0.0f));
}
#else
#define share_beside_lights(path, area_density, share) (share)
#endif

/* The share of the radiance met that is not gather_lamp's: by the balance heuristic, see "Optimally Combining Sampling
   Techniques for Monte Carlo Rendering", by Veach and Guibas. */
static inline lanes_f share_of_met(const World* world, const Path* path, const Hit* hit, lanes_mask counts COUNTED_PARAMETER) {
    (void)counts;
    lanes_u number;
    const lanes_mask is_lamp = lamp_met(world, hit_face(hit), &number);
    if (!lanes_any(is_lamp)) return (lanes_f)(1.0f);
    const LampMet lamp = lamp_at(world, path, hit, number, counts & is_lamp COUNTED_ARGUMENT);
    COUNTED_LANES(counts & is_lamp, LIGHT_SHARE_WORK)
    return lanes_select((lanes_f)(1.0f), share_beside_lights(path, lamp.area_density, share_beside(path, lamp.asked)), is_lamp);
}

/* Adds `radiance`, from a lamp's face along `direction`, to what these matte hits send back, if nothing is between. */
static inline void gather_unless_shadowed(const World* world, Path* path, lanes_mask lit, Vec direction, lanes_f distance,
                                          lanes_u face, Vec radiance, lanes_mask counts COUNTED_PARAMETER) {
    (void)counts;
    COUNTED(counted_lanes(counts & lit) > 0u ? 1u : 0u, SCENE_STEP_WORK(world->scene.count))
    COUNTED_LANES(counts & lit, SCENE_SHADOW_WORK(world->scene))
    COUNTED_LANES(counts & lit, LIGHT_SENT_WORK)
    Ray shadow = path->ray;
    shadow.direction = direction;
    path->shadow_rays += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), lit);
#if PATH_WAITS
    const ShadowRay asked = {lit && may_see(world->scene, &shadow, &path->inside, distance, face), direction, distance, face};
    path->shadow = asked;
    path->awaited = vec_mul(path->throughput, radiance);
#else
    const lanes_mask seen = lit & sees(world->scene, &shadow, &path->inside, distance, face COUNTED_ARGUMENT);
    path->radiance = vec_select(path->radiance, vec_mul_add(path->radiance, path->throughput, radiance), seen);
#endif
}

/* The unit normal on the path's side of matte hits. */
static inline Vec matte_normal(const Path* path, const Surface* surface) {
    return vec_scale(from_centre(&path->ray, surface->centre), surface->matte);
}

/* Next-event estimation: adds the light of a lamp at these matte hits. The bounce that follows finds the lamp, too, with
   `goes_on` as its chance, 0 where it is not asked; this is the share of the sum by the balance heuristic. */
static inline void gather_lamp(const World* world, Path* path, const Surface* surface, lanes_mask matte, lanes_f goes_on,
                               lanes_mask counts COUNTED_PARAMETER) {
    const LampDraw draw = draw_lamp(&path->random);
    if (!lanes_any(matte)) return;
    const LampSample lamp = sample_lamp(world->scene, &world->lamps, path->ray.origin, &draw, counts & matte COUNTED_ARGUMENT);
    COUNTED_CENTRES(path->ray, counts & matte)
    COUNTED_LANES(counts & matte, LIGHT_COSINE_WORK)
    const lanes_f cosine = vec_dot(matte_normal(path, surface), lamp.direction);
    const lanes_mask lit = matte & (cosine > 0.0f) & (lamp.density.whole > 0.0f);
    if (!lanes_any(lit)) return;
    const lanes_f whole = cosine * lamp.density.whole;
    COUNTED_LANES(counts & lit, LIGHT_WEIGHT_WORK)
    const lanes_f share = whole / (PI * lamp.density.part + goes_on * whole);
    gather_unless_shadowed(world, path, lit, lamp.direction, lamp.distance, lamp.face, vec_scale(lamp.radiance, share), counts COUNTED_ARGUMENT);
}

#endif
