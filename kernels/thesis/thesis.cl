/* `thesis`: the algorithm of the 2016 thesis with its habits (everything in global memory, a random state written back
   at every draw, one work-item a pixel) and its defects (kernels/thesis/README.md), without its undefined behaviour. It
   is the throughput baseline; for right pictures there is `pt`. */
#include "lib/strict.h"
#include "shared/thesis.h"
#include "thesis/work.h"

#define NEAREST 0.001f
#define FARTHEST 1e37f

typedef struct Ray {
    float4 origin, direction; /* w is 0; the direction has any length */
} Ray;

typedef struct Hit {
    float distance; /* in lengths of the ray's direction */
    float4 point, normal;
    ThesisMaterial material;
} Hit;

/* Park and Miller's minimal standard generator, modulus 2^31 - 1; uniform in (0, 1). */
static inline float random_next(__global int* state COUNTED_PARAMETER) {
    COUNTED(1u, THESIS_RANDOM_WORK)
    const long next = (long)*state * 16807L % 2147483647L;
    *state = (int)next;
    return (float)next / 2147483647.0f;
}

/* Nearer root of every sphere in (NEAREST, FARTHEST), the nearest of them; each hit copies the whole material. */
static inline bool nearest_hit(__global const ThesisSphere* spheres, uint count, Ray ray, Hit* hit COUNTED_PARAMETER) {
    hit->distance = FARTHEST;
    for (uint i = 0; i < count; ++i) {
        COUNTED(1u, THESIS_TEST_WORK)
        const float4 centre_radius = spheres[i].centre_radius;
        const float4 centre = (float4)(centre_radius.xyz, 0.0f);
        const float4 from_centre = ray.origin - centre;
        const float a = dot(ray.direction, ray.direction);
        const float b = dot(from_centre, ray.direction);
        const float c = dot(from_centre, from_centre) - centre_radius.w * centre_radius.w;
        const float discriminant = b * b - a * c;
        if (discriminant < 0.0f) continue;
        COUNTED(1u, THESIS_ROOT_WORK)
        const float distance = (-b - sqrt(discriminant)) / a;
        if (distance > NEAREST && distance < hit->distance) {
            COUNTED(1u, THESIS_HIT_WORK)
            hit->distance = distance;
            hit->point = ray.origin + ray.direction * distance;
            hit->normal = (hit->point - centre) / centre_radius.w;
            hit->material = spheres[i].material;
        }
    }
    return hit->distance < FARTHEST;
}

/* A point of the cube [-1, 1]^3 on the normal's side, normalised: neither uniform nor cosine-weighted. */
static inline float4 matte_direction(float4 normal, __global int* state COUNTED_PARAMETER) {
    COUNTED(1u, THESIS_MATTE_WORK)
    const float x = random_next(state COUNTED_ARGUMENT);
    const float y = random_next(state COUNTED_ARGUMENT);
    const float z = random_next(state COUNTED_ARGUMENT);
    const float4 direction = normalize((float4)(2.0f * x - 1.0f, 2.0f * y - 1.0f, 2.0f * z - 1.0f, 0.0f));
    return dot(direction, normal) < 0.0f ? -direction : direction;
}

static inline float4 reflected(float4 direction, float4 normal COUNTED_PARAMETER) {
    COUNTED(1u, THESIS_REFLECTION_WORK)
    return direction - normal * (2.0f * dot(direction, normal));
}

/* Schlick's approximation, used the wrong way round: with its probability the ray is refracted. */
static inline float4 dielectric_direction(Ray ray, const Hit* hit, __global int* state COUNTED_PARAMETER) {
    COUNTED(1u, THESIS_DIELECTRIC_WORK)
    const bool entering = dot(ray.direction, hit->normal) < 0.0f;
    const float4 normal = entering ? hit->normal : -hit->normal;
    const float eta = entering ? 1.0f / hit->material.ior : hit->material.ior;
    const float cosine = -dot(ray.direction, normal);
    const float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
    COUNTED(entering, THESIS_ENTERING_WORK)
    if (k < 0.0f) return reflected(ray.direction, normal COUNTED_ARGUMENT);
    COUNTED(1u, THESIS_SCHLICK_WORK)
    const float root = (1.0f - hit->material.ior) / (1.0f + hit->material.ior);
    const float at_normal = root * root;
    const float away = 1.0f - cosine;
    const float reflectance = at_normal + (1.0f - at_normal) * away * away * away * away * away;
    const float u = random_next(state COUNTED_ARGUMENT);
    COUNTED(u < reflectance, THESIS_REFRACTION_WORK)
    if (u < reflectance) return ray.direction * eta + normal * (eta * cosine - sqrt(k));
    return reflected(ray.direction, normal COUNTED_ARGUMENT);
}

/* Radiance of one path, its segments in w; black unless the path ends on a light. */
static inline float4 trace(__global const ThesisSphere* spheres, uint count, Ray ray, uint path_length,
                           __global int* state COUNTED_PARAMETER) {
    float4 radiance = (float4)(0.0f);
    float4 weight = (float4)(1.0f);
    Hit hit;
    for (uint segment = 1; segment <= path_length; ++segment) {
        COUNTED_SEGMENTS(1u)
        if (!nearest_hit(spheres, count, ray, &hit COUNTED_ARGUMENT)) return (float4)(0.0f, 0.0f, 0.0f, (float)segment);
        COUNTED(1u, THESIS_GATHER_WORK)
        radiance += weight * hit.material.radiance;
        if (!hit.material.scatters) return (float4)(radiance.xyz, (float)segment);
        ray.origin = hit.point;
        if (hit.material.type == THESIS_MIRROR) {
            ray.direction = reflected(ray.direction, hit.normal COUNTED_ARGUMENT);
        } else if (hit.material.type == THESIS_DIELECTRIC) {
            ray.direction = dielectric_direction(ray, &hit, state COUNTED_ARGUMENT);
        } else {
            ray.direction = matte_direction(hit.normal, state COUNTED_ARGUMENT);
        }
        COUNTED(hit.material.type != THESIS_DIELECTRIC, THESIS_WEIGHT_WORK)
        if (hit.material.type != THESIS_DIELECTRIC) weight *= hit.material.colour;
    }
    return (float4)(0.0f, 0.0f, 0.0f, (float)path_length);
}

__kernel void thesis_render(__global float4* result, __global int* states, __global const ThesisSphere* spheres,
                            const ThesisLaunch launch COUNTED_ROWS) {
    /* One dimension: the pixels; two: columns and rows. Ranges are rounded up to whole work-groups. */
    const uint column = (uint)get_global_id(0);
    const uint row = (uint)get_global_id(1);
    if (get_work_dim() == 2 && column >= launch.width) return;
    const uint index = row * launch.width + column;
    if (index >= launch.pixels) return;
    COUNTED_BEGIN
    const uint pixel = launch.first_pixel + index;
    __global int* state = &states[pixel];
    for (uint i = 0; i < launch.samples; ++i) {
        const float jitter_x = random_next(state COUNTED_ARGUMENT);
        const float jitter_y = random_next(state COUNTED_ARGUMENT);
        Ray ray;
        ray.origin = launch.camera.position;
        ray.direction = launch.camera.corner + launch.camera.step_x * ((float)(pixel % launch.width) + jitter_x) +
                        launch.camera.step_y * ((float)(pixel / launch.width) + jitter_y);
        const float4 sample = trace(spheres, launch.sphere_count, ray, launch.path_length, state COUNTED_ARGUMENT);
        const float4 share = (float4)((float3)(1.0f / (float)launch.spp), 1.0f);
        result[pixel] += sample * share;
        COUNTED(1u, THESIS_SAMPLE_WORK)
    }
    COUNTED_END
}
