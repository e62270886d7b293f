/* Offset paths: what a camera path becomes when it is shifted into a neighbouring pixel. See "Gradient-Domain Bidirectional Path
   Tracing", by M. Manzi, M. Kettunen, M. Aittala, J. Lehtinen, F. Durand and M. Zwicker. A shifted path follows the base path
   through mirrors and glass to its first matte vertex, and is joined to the base path's next one, be that matte or on a lamp.
   The rest is the base path's. Where that cannot be, in one direction or the other, the shift fails, and the difference is the
   base path's own light. */
#ifndef PTB_GBDPT_OFFSET_H
#define PTB_GBDPT_OFFSET_H

#include "bdpt/join.h"
#include "bdpt/lamp.h"
#include "engine/gradients.h"
#include "gbdpt/work.h"

/* A density ratio that is large enough. */
#define MOST_LIKELY 1e12f

/* What a shifted path carries lies in private memory, which is what a GPU waits for; so a place holds one thing after another: of
   the path on its way, of its first matte vertex, and of what it is worth once it has joined the base path. Of a ray it has origin
   and direction alone, so paths among triangles, and those that carry gaps, cannot be shifted. */
typedef struct Offset {
    Vec place;          /* the ray's origin; the vertex' position; then the light that comes along the base path, each over the
                           density of both by all strategies */
    Vec direction;      /* the ray's; the vertex' normal */
    Vec throughput;     /* the path's; the vertex' weight; then what that light is worth to it, in units of the base's density */
    lanes_f likelihood; /* its density over the base path's: of choices at glass, later of all */
    lanes_f odds;       /* the vertex'; then by how much its odds of earlier strategies exceed the base path's */
    lanes_f density;    /* the vertex' */
    Sides inside;
    lanes_mask follows;
} Offset;

/* The base path. */
typedef struct Base {
    Vec prefix;         /* what it is worth up to its second vertex of interest, the one after its first matte one */
    Vec shared;         /* the light that comes after, over its density by all strategies */
    lanes_mask in_chain; /* the lanes that have met mirrors and glass alone */
    lanes_mask joins;    /* the lanes on the way to the vertex after the first matte one, */
    lanes_mask joined;   /* and those that have come there */
} Base;

/* The camera's direction through the same place of a neighbouring pixel. */
ALWAYS_INLINE Vec shifted_direction(const Picture* picture, Vec direction, lanes_f cosine, uint neighbour,
                                    lanes_mask counts COUNTED_PARAMETER) {
    (void)counts;
    COUNTED_LANES(counts, GBDPT_DIRECTION_WORK)
    const float4 axis = neighbour < 2u ? picture->frame.across : picture->frame.down;
    const float step = ((neighbour & 1u) == 0u ? 1.0f : -1.0f) / (axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
    return vec_normalize(vec_add_scaled(vec_scale(direction, 1.0f / cosine), vec_of(axis), (lanes_f)(step)));
}

/* Where its first matte vertex is. Of a lone sphere's face nothing has to be known to start there. */
ALWAYS_INLINE Vertex first_vertex(const Offset* offset) {
    Vertex vertex;
    vertex.position = offset->place;
    vertex.normal = offset->direction;
    vertex.weight = offset->throughput;
    vertex.odds = offset->odds;
    vertex.density = offset->density;
    vertex.inside = offset->inside;
    vertex.face = (lanes_u)(0u);
    vertex.joins = offset->follows;
    return vertex;
}

ALWAYS_INLINE void start_offset(Offset* offset, const Path* path, Vec direction) {
    offset->place = path->ray.origin;
    offset->direction = direction;
    offset->throughput = vec_of((float4)(1.0f));
    offset->likelihood = (lanes_f)(1.0f);
    offset->odds = offset->density = (lanes_f)(0.0f);
    offset->inside = path->inside;
    offset->follows = lanes_all();
}

/* Reflectance of unpolarised light, 1 where it is total; see scene/scatter.h. */
ALWAYS_INLINE lanes_f reflectance(lanes_f along, const Surface* surface) {
    const lanes_f eta_cos = -along * surface->before;
    const lanes_f cos_t = lanes_sqrt(eta_cos * eta_cos + surface->less_eta_squared);
    const lanes_f across = (eta_cos - cos_t) / (eta_cos + cos_t);
    const lanes_f plane = (eta_cos - surface->eta_squared * cos_t) / (eta_cos + surface->eta_squared * cos_t);
    const lanes_f share = 0.5f * (across * across + plane * plane);
    return lanes_select((lanes_f)(1.0f), share, share < 1.0f); /* with a NaN 1 */
}

/* The chance that a path takes the way that it does, and goes on, at a mirror or glass that it meets with this cosine. */
ALWAYS_INLINE lanes_f chance_of(const Arrival* met, lanes_f along, lanes_mask through, lanes_mask counts COUNTED_PARAMETER) {
    (void)counts;
    COUNTED_LANES(counts, GBDPT_CHANCE_WORK)
    const Surface* surface = &met->surface;
    const lanes_f back = reflectance(along, surface);
    const lanes_mask is_glass = surface->eta_squared == surface->eta_squared;
    return met->goes_on * lanes_select((lanes_f)(1.0f), lanes_select(back, 1.0f - back, through), is_glass);
}

/* Sends a ray on from a mirror, or from glass the way that is asked for; returns the chance of that. */
ALWAYS_INLINE lanes_f scatter_alike(const World* world, Ray* ray, Sides* inside, const Arrival* met, lanes_mask through,
                                    lanes_mask counts COUNTED_PARAMETER) {
    const Surface* surface = &met->surface;
    const Vec outwards = from_centre(ray, surface->centre);
    const lanes_f along = vec_dot(ray->direction, outwards);
    lanes_f normal = -surface->mirrored * along;
    if (two_sided_spheres(world->scene) > 0u) {
        COUNTED_LANES(counts, GBDPT_PASS_WORK)
        const lanes_mask passes = through & (surface->eta_squared == surface->eta_squared);
        const lanes_f eta_cos = -along * surface->before;
        const lanes_f cos_t = lanes_sqrt(lanes_max(eta_cos * eta_cos + surface->less_eta_squared, (lanes_f)(0.0f)));
        normal = lanes_select(normal, 0.5f * normal - cos_t * surface->beyond, passes);
        change_sides(world->scene, inside, met->face, passes);
    }
    ray->direction = vec_normalize(vec_add_scaled(ray->direction, outwards, normal));
    return chance_of(met, along, through, counts COUNTED_ARGUMENT);
}

static inline Vec over_chance_vec(Vec a, lanes_f chance) { return vec_scale(a, over_chance((lanes_f)(1.0f), chance)); }

/* Adds to a difference what a path is worth, `own`, and what its shifted path is, `other`, both in units of the path's density by the
   strategy that made it, over the densities of both by all strategies, `sum` and `other_sum`. */
ALWAYS_INLINE void add_difference(Vec* toward, Vec own, lanes_f sum, Vec other, lanes_f other_sum, lanes_mask counts COUNTED_PARAMETER) {
    COUNTED_LANES(counts, GBDPT_DIFFERENCE_WORK)
    const lanes_f inverse = 1.0f / (sum + other_sum);
    *toward = vec_select(*toward, vec_add_scaled(*toward, vec_sub(other, own), inverse), counts);
}

/* Light that comes along the base path from beyond its first two matte vertices: `sum` is its density by all strategies, in units
   of that of the one that made it, and grows by `per_odds` with the odds of earlier ones. */
ALWAYS_INLINE void add_shared(Base* base, Offset* offsets, Vec light, lanes_f sum, lanes_f per_odds, lanes_mask counts COUNTED_PARAMETER) {
    if (!lanes_any(counts)) return;
    COUNTED_LANES(counts, GBDPT_SHARED_WORK)
    base->shared = vec_select(base->shared, vec_add_scaled(base->shared, light, 1.0f / sum), counts);
    for (uint i = 0; i < NEIGHBOURS; ++i) {
        Offset* offset = &offsets[i];
        COUNTED_LANES(counts, GBDPT_OFFSET_WORK)
        const lanes_f both = sum + offset->likelihood * (sum + per_odds * offset->odds);
        offset->place = vec_select(offset->place, vec_add_scaled(offset->place, light, 1.0f / both), counts);
    }
}

/* What a path met of a lamp. */
typedef struct Shine {
    Vec light;
    lanes_f sum;       /* of the densities of all strategies, over the path's own */
    lanes_f per_odds;  /* 0 where the lamp cannot be asked */
    Lamp lamp;
    lanes_mask shines;
} Shine;

ALWAYS_INLINE Shine no_shine(void) {
    const Vec zero = vec_of((float4)(0.0f));
    const lanes_f nothing = (lanes_f)(0.0f);
    Shine shine;
    shine.light = shine.lamp.centre = shine.lamp.axis = shine.lamp.radiance = zero;
    shine.lamp.radius = shine.lamp.extent = shine.lamp.chance = shine.lamp.cap_density = shine.lamp.near_squared = nothing;
    shine.lamp.face = (lanes_u)(0u);
    shine.sum = (lanes_f)(1.0f);
    shine.per_odds = nothing;
    shine.shines = lanes_none();
    return shine;
}

/* `ray` is the one that met it. */
ALWAYS_INLINE Shine shine_of(const World* world, const Ray* ray, Vec throughput, const Arrival* met, const Odds* odds,
                             lanes_mask alive COUNTED_PARAMETER) {
    Shine shine = no_shine();
    COUNTED_LANES(alive, GBDPT_SHINE_WORK)
    const Vec radiance = radiance_of(&world->surfaces, met->face);
    shine.light = vec_mul(throughput, radiance);
    shine.shines = alive & (radiance.x + radiance.y + radiance.z > 0.0f);
    lanes_u number;
    const lanes_mask is_lamp = lamp_met(world, met->face, &number);
    if (world->lamps.count == 0u || !lanes_any(shine.shines & is_lamp)) return shine;
    COUNTED_LANES(shine.shines & is_lamp, GBDPT_LAMP_WORK)
    shine.lamp = lamp_of(&world->lamps, number);
    const Density density = density_of_way(&shine.lamp, ray, hit_distance(&met->hit), shine.shines & is_lamp COUNTED_ARGUMENT);
    shine.per_odds = lanes_select((lanes_f)(0.0f), shine.lamp.cap_density * (1.0f / PI), is_lamp);
    const lanes_f asked = odds->last * density.part / (density.whole + 1e-30f);
    shine.sum = lanes_select(shine.sum, 1.0f + shine.per_odds * odds->earlier + asked, is_lamp);
    return shine;
}

/* Follows the base path, from `before` to what it met, by its shifted path. */
ALWAYS_INLINE void follow(const World* world, const Picture* picture, Offset* offset, Vec* toward, const Arrival* base_met,
                          const Shine* shine, lanes_mask through, lanes_f base_chance, uint segment, lanes_mask in_chain,
                          Traced* traced COUNTED_PARAMETER) {
    const lanes_mask wanted = in_chain & offset->follows, shines = in_chain & shine->shines;
    if (!lanes_any(wanted)) {
        if (lanes_any(shines))
            add_difference(toward, shine->light, (lanes_f)(1.0f), vec_of((float4)(0.0f)), (lanes_f)(0.0f), shines COUNTED_ARGUMENT);
        return;
    }
    COUNTED_MEETING(world->scene, wanted)
    COUNTED_LANES(wanted, GBDPT_FOLLOW_WORK)
    Path shifted;
    shifted.ray.origin = offset->place;
    shifted.ray.direction = offset->direction;
    shifted.inside = offset->inside;
    shifted.throughput = offset->throughput;
    traced->light_segments += lanes_select_u((lanes_u)(0u), (lanes_u)(1u), wanted);
    const Arrival met = meet(world, &shifted COUNTED_ARGUMENT);
    const lanes_f distance = hit_distance(&met.hit);

    if (lanes_any(shines)) {
        COUNTED_LANES(shines & wanted, GBDPT_MEETS_WORK)
        const Vec radiance = radiance_of(&world->surfaces, met.face);
        const lanes_mask meets_lamp = wanted & (radiance.x + radiance.y + radiance.z > 0.0f);
        const lanes_f likelihood = lanes_select((lanes_f)(0.0f), offset->likelihood, meets_lamp);
        const Vec other = vec_scale(vec_mul(shifted.throughput, radiance), likelihood);
        add_difference(toward, shine->light, (lanes_f)(1.0f), other, likelihood, shines COUNTED_ARGUMENT);
    }

    Odds odds;
    const lanes_f cosine = vec_dot(shifted.ray.direction, vec_of(picture->frame.axis_area));
    odds.last = odds.earlier = (lanes_f)(0.0f);
    if (segment == 1u) {
        COUNTED_LANES(wanted, GBDPT_FIRST_WORK)
    }
    const lanes_f last = segment == 1u ? inverse_of_picture(picture, cosine) * distance * distance : (lanes_f)(0.0f);
    const Vertex vertex = move_to_vertex(&shifted, &met, &odds, last, lanes_none() COUNTED_ARGUMENT);
    const lanes_mask is_first = wanted & base_met->matte, goes_on = wanted & !base_met->matte;
    offset->place = vec_select(offset->place, vertex.position, is_first);
    offset->direction = vec_select(offset->direction, vertex.normal, is_first);
    offset->throughput = vec_select(offset->throughput, vertex.weight, is_first);
    offset->odds = lanes_select(offset->odds, vertex.odds, is_first);
    offset->density = lanes_select(offset->density, vertex.density, is_first);

    const lanes_mask is_glass = met.surface.eta_squared == met.surface.eta_squared;
    const lanes_mask base_is_glass = base_met->surface.eta_squared == base_met->surface.eta_squared;
    const lanes_f chance = scatter_alike(world, &shifted.ray, &shifted.inside, &met, through, wanted COUNTED_ARGUMENT);
    const lanes_mask alike = (met.matte & base_met->matte) |
                             ((met.surface.mirrored > 0.0f) & (base_met->surface.mirrored > 0.0f) &
                              ((is_glass & base_is_glass) | (!is_glass & !base_is_glass)) & (chance > 0.0f));
    offset->follows &= !in_chain | alike;
    offset->place = vec_select(offset->place, shifted.ray.origin, goes_on);
    offset->direction = vec_select(offset->direction, shifted.ray.direction, goes_on);
    offset->inside = sides_select(&offset->inside, &shifted.inside, goes_on);
    offset->throughput = vec_select(offset->throughput, over_chance_vec(shifted.throughput, met.goes_on), goes_on);
    offset->likelihood = lanes_select(offset->likelihood, offset->likelihood * chance / base_chance, goes_on);
}

/* Ends shifted paths that cannot be joined to the base path. */
ALWAYS_INLINE void end_offset(Offset* offset, const Shine* shine, lanes_mask joins COUNTED_PARAMETER) {
    const Vec zero = vec_of((float4)(0.0f));
    offset->place = vec_select(offset->place, zero, joins);
    offset->throughput = vec_select(offset->throughput, zero, joins);
    offset->likelihood = lanes_select(offset->likelihood, (lanes_f)(0.0f), joins);
    offset->odds = lanes_select(offset->odds, (lanes_f)(0.0f), joins);
    const lanes_mask shines = joins & shine->shines;
    if (!lanes_any(shines)) return;
    COUNTED_LANES(shines, GBDPT_SHARED_WORK)
    offset->place = vec_select(offset->place, vec_add_scaled(offset->place, shine->light, 1.0f / shine->sum), shines);
}

/* Joins a shifted path to the base path's vertex after the first matte one, where the base path has come from along `ray`. */
ALWAYS_INLINE void join_base(const World* world, const Path* path, const Ray* ray, const Arrival* met, const Vertex* view,
                             const Odds* odds, const Shine* shine, Offset* offset, lanes_mask joins, Traced* traced COUNTED_PARAMETER) {
    const lanes_mask may = joins & offset->follows & (met->matte | shine->shines);
    const lanes_mask shines = joins & shine->shines;
    if (!lanes_any(may)) {
        end_offset(offset, shine, joins COUNTED_ARGUMENT);
        return;
    }
    COUNTED_LANES(may, GBDPT_BASE_WAY_WORK)
    const Vec outwards = from_centre(&path->ray, met->surface.centre);
    const Vertex first = first_vertex(offset);
    const Vec way = vec_sub(path->ray.origin, first.position);
    const lanes_f squared = vec_dot(way, way), inverse = lanes_rsqrt(squared), distance = squared * inverse;
    Ray other;
    other.origin = first.position;
    other.direction = vec_scale(way, inverse);
    const lanes_f cosine = vec_dot(first.normal, other.direction);
    const lanes_f along = vec_dot(other.direction, outwards), base_along = vec_dot(ray->direction, outwards);
    const lanes_mask wanted = may & (cosine > 0.0f) & (along * base_along > 0.0f) &
                              !sides_differ(&first.inside, &view->inside);
    lanes_mask seen = lanes_none();
    if (lanes_any(wanted))
        seen = sees_from(world, &first, other.direction, distance, met->face, wanted, traced COUNTED_ARGUMENT);
    if (!lanes_any(seen)) {
        end_offset(offset, shine, joins COUNTED_ARGUMENT);
        return;
    }
    COUNTED_LANES(seen, GBDPT_BASE_WORK)
    const lanes_f base_distance = hit_distance(&met->hit);
    const lanes_f geometry = cosine * along * inverse * inverse / base_along * base_distance * base_distance;
    const lanes_f ratio = lanes_min(geometry * odds->last * offset->likelihood, (lanes_f)(MOST_LIKELY));
    const lanes_f likelihood = lanes_select((lanes_f)(0.0f), ratio * first.density, seen);
    offset->throughput = vec_select(offset->throughput, vec_scale(first.weight, lanes_select((lanes_f)(0.0f), ratio, seen)), joins);
    offset->place = vec_select(offset->place, vec_of((float4)(0.0f)), joins);
    offset->likelihood = lanes_select(offset->likelihood, likelihood, joins);

    /* densities of the way there and of all before it, as in Odds */
    const lanes_f inverse_density = 1.0f / lanes_max(first.density, (lanes_f)(1e-20f));
    const lanes_f last = inverse_density / cosine, earlier = first.odds * inverse_density;
    if (BDPT_ENDS == 2) {
        COUNTED_LANES(seen, GBDPT_BASE_ODDS_WORK)
        const lanes_f at_vertex = -last * squared / vec_dot(view->normal, other.direction) + earlier * view->density;
        const lanes_f more = (at_vertex - view->odds) / lanes_max(view->density, (lanes_f)(1e-20f));
        offset->odds = lanes_select(offset->odds, lanes_select((lanes_f)(0.0f), more, seen & met->matte), joins);
    }

    if (!lanes_any(shines)) return;
    COUNTED_LANES(shines, GBDPT_BASE_SHINE_WORK)
    lanes_f other_sum = (lanes_f)(1.0f);
    if (lanes_any(shine->per_odds > 0.0f)) {
        COUNTED_LANES(shines, GBDPT_BASE_LAMP_WORK)
        const Density density = density_of_way(&shine->lamp, &other, distance, shines COUNTED_ARGUMENT);
        other_sum = 1.0f + shine->per_odds * earlier +
                    lanes_select((lanes_f)(0.0f), last * density.part / (density.whole + 1e-30f), shine->per_odds > 0.0f);
    }
    const lanes_f both = shine->sum + lanes_select((lanes_f)(0.0f), likelihood * other_sum, seen);
    offset->place = vec_select(offset->place, vec_add_scaled(offset->place, shine->light, 1.0f / both), shines);
}

#endif
