/* The vertices of paths from either end, and how likely the same path is by other strategies. */
#ifndef PTB_BDPT_VERTEX_H
#define PTB_BDPT_VERTEX_H

/* Ends that paths start from: with 1, the camera, no other strategy makes a path but that of asking a lamp. */
#ifndef BDPT_ENDS
#define BDPT_ENDS 2
#endif

/* Most segments of a path. */
#ifndef ENGINE_PATH_LENGTH
#define ENGINE_PATH_LENGTH 8
#endif

#include "engine/light.h"
#include "engine/splat.h"
#include "bdpt/work.h"
#include "scene/scatter.h"

/* How many times as likely as by this end a path's start is by strategies that give the other end more of it, as the sums that
   grow along it: see "Implementing Vertex Connection and Merging", by I. Georgiev, sections 4 and 5, where the first is
   d_VCM and the second d_VC. Matte surfaces send light by the cosine alone, so the cosines that it divides `earlier` by at
   a hit and multiplies it by at the next bounce are left out. */
typedef struct Odds {
    lanes_f last;    /* if the other end makes the vertex that comes next, and no more: 1 / density of the way there, by solid
                        angle; 0 where a mirror or glass left no choice */
    lanes_f earlier; /* if it makes more than that */
} Odds;

/* What a path meets. */
typedef struct Arrival {
    Hit hit;
    Surface surface;
    lanes_u face;
    lanes_mask matte, ends;
    lanes_f goes_on; /* chance */
} Arrival;

/* Where a path may be joined to another. */
typedef struct Vertex {
    Vec position, normal; /* the normal of length 1, on the path's side */
    Vec weight;           /* of light that goes on to another vertex, over both cosines */
    lanes_f odds;         /* of all strategies that give the other end more, for a density of 1 at this vertex */
    lanes_f density;      /* by solid angle, of a direction whose cosine is 1 */
    Sides inside;
    lanes_u face;         /* as `sees` has its target */
    lanes_mask joins;     /* matte, and of a path that came so far */
} Vertex;

ALWAYS_INLINE Arrival meet(const World* world, const Path* path COUNTED_PARAMETER) {
    Arrival met;
    met.hit = nearest_hit(world->scene, &path->ray, &path->inside COUNTED_ARGUMENT);
    met.face = hit_face(&met.hit);
    met.surface = surface_of(&world->surfaces, met.face);
    met.matte = met.surface.mirrored == 0.0f;
    met.ends = met.surface.mirrored < 0.0f;
    met.goes_on = chance_to_go_on(&met.surface);
    return met;
}

/* Moves a path to what it met. The vertex there lacks odds and density, which say how it is reached by other strategies. */
ALWAYS_INLINE Vertex move_there(Path* path, const Arrival* met, lanes_mask alive) {
    move_to_hit(&path->ray, &met->hit);
    path->throughput = vec_mul(path->throughput, met->surface.weight);
    Vertex vertex;
    vertex.position = path->ray.origin;
    vertex.normal = matte_normal(path, &met->surface);
    vertex.weight = vec_scale(path->throughput, (lanes_f)(1.0f / PI));
    vertex.odds = vertex.density = (lanes_f)(0.0f);
    vertex.inside = path->inside;
    vertex.face = target_at(&path->ray, met->face);
    vertex.joins = alive & met->matte;
    return vertex;
}

/* Moves a path to what it met. `last` is the density by area with which the other end makes the vertex there, over this
   end's, for a density by solid angle of 1 and a cosine of 1. */
ALWAYS_INLINE Vertex move_to_vertex(Path* path, const Arrival* met, Odds* odds, lanes_f last, lanes_mask alive COUNTED_PARAMETER) {
    Vertex vertex = move_there(path, met, alive);
    COUNTED_LANES(alive, BDPT_VERTEX_WORK)
    COUNTED_CENTRES(path->ray, alive)
    vertex.density = met->goes_on * (1.0f / PI);
    if (BDPT_ENDS == 1) return vertex;
    odds->last = -last / vec_dot(vertex.normal, path->ray.direction);
    vertex.odds = odds->last + odds->earlier * vertex.density;
    return vertex;
}

/* The squared index of refraction that paths passed into, over that which they came from. */
ALWAYS_INLINE lanes_f squeezed_by(const Surface* surface, const Path* path, const Sides* before) {
    return lanes_select((lanes_f)(1.0f), surface->eta_squared, has_passed(&path->ray, before, &path->inside));
}

/* Sends a path on from what it met; returns the lanes that go on. `carries` light, not a view: radiance here is not scaled by the
   squared index of refraction, so light that passes glass is. */
ALWAYS_INLINE lanes_mask bounce(const World* world, Path* path, const Arrival* met, Odds* odds, bool carries,
                                lanes_mask alive COUNTED_PARAMETER) {
    const Vec draw = draw_bounce(&path->random);
    const Sides before = path->inside;
    const lanes_f half_inverse_cosine = scatter(world->scene, &path->ray, &path->inside, &met->hit, &met->surface, &draw COUNTED_ARGUMENT);
    const lanes_mask goes_on = alive & !met->ends & !dies(path, met->goes_on);
    COUNTED_LANES(alive, BDPT_BOUNCE_WORK)
    COUNTED(BDPT_ENDS == 2 && scene_refracts(world->scene) ? counted_lanes(alive) : 0u, BDPT_GLASS_WORK(carries))
    const lanes_f inverse_chance = over_chance((lanes_f)(PI), met->goes_on);
    if (BDPT_ENDS == 2)
        odds->earlier = lanes_select(odds->earlier, odds->earlier + odds->last * inverse_chance, met->matte);
    odds->last = lanes_select((lanes_f)(0.0f), 2.0f * half_inverse_cosine * inverse_chance, met->matte);
    if (BDPT_ENDS == 2 && scene_refracts(world->scene)) {
        const lanes_f squeezed = squeezed_by(&met->surface, path, &before);
        odds->earlier = odds->earlier * squeezed;
        if (carries) path->throughput = vec_scale(path->throughput, squeezed);
    }
    /* what others trace on is worth nothing, and stays a number */
    if (PTB_LANES > 1) path->throughput = vec_select(vec_of((float4)(0.0f)), path->throughput, goes_on);
    return goes_on;
}

#endif
