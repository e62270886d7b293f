/* The scene as `pt` sees it, and where a ray meets it. */
#ifndef PTB_PT_SCENE_H
#define PTB_PT_SCENE_H

#include "lib/roots.h"
#include "lib/vec.h"
#include "shared/pt.h"

/* 32-bit words that hold one side bit per two-sided sphere. */
#ifndef PT_SIDE_WORDS
#define PT_SIDE_WORDS 1
#endif

/* PT_FEW, the number of spheres if it is at most PT_FEW_MOST. They are best a kernel argument: on GPUs each number is then
   an operand of the instruction that uses it. Surfaces are best copied to local memory there (1.02, H200). */
#ifndef PT_SPHERES
#ifdef PT_FEW
#define PT_SPHERES PT_IN_ARGUMENT
#else
#define PT_SPHERES PT_IN_CONSTANT
#endif
#endif
#ifndef PT_SURFACES
#define PT_SURFACES PT_IN_CONSTANT
#endif
#ifndef PT_COUNT
#define PT_COUNT PT_FEW
#endif

/* Address spaces: of the buffer, and of what rays read, which may be a copy of it. */
#if PT_SPHERES == PT_IN_CONSTANT
#define PT_SPHERE_BUFFER __constant
#define PT_SPHERE_SPACE __constant
#elif PT_SPHERES == PT_IN_GLOBAL
#define PT_SPHERE_BUFFER __global
#define PT_SPHERE_SPACE __global
#elif PT_SPHERES == PT_IN_LOCAL
#define PT_SPHERE_BUFFER __global
#define PT_SPHERE_SPACE __local
#else
#define PT_SPHERE_BUFFER __global
#define PT_SPHERE_SPACE __private
#endif
#if PT_SURFACES == PT_IN_CONSTANT
#define PT_SURFACE_BUFFER __constant
#define PT_SURFACE_SPACE __constant
#elif PT_SURFACES == PT_IN_GLOBAL
#define PT_SURFACE_BUFFER __global
#define PT_SURFACE_SPACE __global
#elif PT_SURFACES == PT_IN_LOCAL
#define PT_SURFACE_BUFFER __global
#define PT_SURFACE_SPACE __local
#else
#define PT_SURFACE_BUFFER __global
#define PT_SURFACE_SPACE __private
#endif

typedef struct Scene {
    PT_SPHERE_SPACE const PtSphere* spheres; /* opaque ones first, then two-sided ones */
    uint opaque;
    uint count;
    uint distance_mask; /* see pt/hit.h */
} Scene;

/* Which two-sided spheres a path is inside: a bit each, from the top. Only transmission changes it. */
typedef struct Sides {
    lanes_u word[PT_SIDE_WORDS];
} Sides;

static inline lanes_mask is_inside(const Sides* inside, uint number) {
    return lanes_as_i(inside->word[number / 32u] << (number % 32u)) < 0;
}

/* The same for a sphere of each lane's own, as its surface names it: by its number (PT_OPAQUE_SIDE: always outside), or
   by its bit where one word holds all. */
#if PT_SIDE_WORDS == 1

static inline lanes_mask is_inside_own(const Sides* inside, lanes_u bit) {
    return (inside->word[0] & bit) != (lanes_u)(0u);
}
static inline void change_sides(Sides* inside, lanes_u bit, lanes_mask through) {
    inside->word[0] ^= lanes_select_u((lanes_u)(0u), bit, through);
}

#else

static inline lanes_mask is_inside_own(const Sides* inside, lanes_u number) {
    lanes_u word = (lanes_u)(0u);
    for (uint i = 0; i < PT_SIDE_WORDS; ++i) {
        word = lanes_select_u(word, inside->word[i], (number >> 5) == (lanes_u)(i));
    }
    return lanes_as_i(word << (number & 31u)) < 0;
}
static inline void change_sides(Sides* inside, lanes_u number, lanes_mask through) {
    const lanes_u bit = (lanes_u)(0x80000000u) >> (number & 31u);
    for (uint i = 0; i < PT_SIDE_WORDS; ++i) {
        inside->word[i] ^= lanes_select_u((lanes_u)(0u), bit, through & ((number >> 5) == (lanes_u)(i)));
    }
}

#endif

typedef struct Ray {
    Vec origin, direction; /* the direction has length 1 */
#ifdef PT_CARRIED
    lanes_f gap[PT_FEW]; /* see pt/hit.h */
#endif
} Ray;

#endif
