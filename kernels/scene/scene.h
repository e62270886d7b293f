/* Spheres, and on which side of the two-sided ones a path is. */
#ifndef PTB_SCENE_SCENE_H
#define PTB_SCENE_SCENE_H

#include "lib/roots.h"
#include "lib/vec.h"
#include "shared/scene.h"

/* SCENE_TREE, 2 or 8: the children of a node of the tree that triangles lie in, if there are any; TREE_QUANTISED: its two
   boxes are of 16 bits a plane. Rays are alone in their work-item then. */
#ifdef SCENE_TREE
typedef struct Tree {
    __global const float4* nodes;  /* of TreeNode2, TreeNode2q or TreeNode8 */
    __global const float4* leaves; /* of TreeTriangle or TreeBlock8 */
    TreeGrid grid;                 /* of TreeNode2q */
} Tree;
/* Handed down to where a Scene is made. */
#define SCENE_TREE_PARAMETERS \
    __global const float4 *tree_nodes, __global const float4 *tree_leaves, const TreeGrid tree_grid, \
        __global const SceneTriangle *triangles,
#define SCENE_TREE_ARGUMENTS tree_nodes, tree_leaves, tree_grid, triangles,
#define SCENE_TREE_MEMBERS , {tree_nodes, tree_leaves, tree_grid}, triangles
#else
#define SCENE_TREE_PARAMETERS
#define SCENE_TREE_ARGUMENTS
#define SCENE_TREE_MEMBERS
#endif

/* 32-bit words that hold one side bit per two-sided sphere. */
#ifndef SCENE_SIDE_WORDS
#define SCENE_SIDE_WORDS 1
#endif

/* SCENE_FEW, the number of spheres if it is at most SCENE_FEW_MOST. They are best a kernel argument: on GPUs each number is then
   an operand of the instruction that uses it. Surfaces are best copied to local memory there (1.02, H200). */
#ifndef SCENE_SPHERES
#ifdef SCENE_FEW
#define SCENE_SPHERES SCENE_IN_ARGUMENT
#else
#define SCENE_SPHERES SCENE_IN_CONSTANT
#endif
#endif
#ifndef SCENE_SURFACES
#define SCENE_SURFACES SCENE_IN_CONSTANT
#endif
#ifdef SCENE_FEW
#define SCENE_COUNT SCENE_FEW
#define SCENE_FACES (2 * SCENE_FEW - SCENE_OPAQUE)
#endif

/* Address spaces by number, SCENE_IN_...: of the buffer, and of what rays read, which may be a copy of it. */
#define SCENE_BUFFER_0 __global
#define SCENE_BUFFER_1 __constant
#define SCENE_BUFFER_2 __global
#define SCENE_BUFFER_3 __global
#define SCENE_BUFFER_4 __global
#define SCENE_SPACE_0 __private
#define SCENE_SPACE_1 __constant
#define SCENE_SPACE_2 __global
#define SCENE_SPACE_3 __local
#define SCENE_SPACE_4 __private
#define SCENE_PASTE_(a, b) a##b
#define SCENE_PASTE(a, b) SCENE_PASTE_(a, b)
#define SCENE_SPHERE_BUFFER SCENE_PASTE(SCENE_BUFFER_, SCENE_SPHERES)
#define SCENE_SPHERE_SPACE SCENE_PASTE(SCENE_SPACE_, SCENE_SPHERES)
#define SCENE_SURFACE_BUFFER SCENE_PASTE(SCENE_BUFFER_, SCENE_SURFACES)
#define SCENE_SURFACE_SPACE SCENE_PASTE(SCENE_SPACE_, SCENE_SURFACES)

typedef struct Scene {
    SCENE_SPHERE_SPACE const SceneSphere* spheres; /* opaque ones first, then two-sided ones */
    uint opaque;
    uint count;
    uint distance_mask; /* SCENE_DISTANCE_MASK, hidden from the compiler: and with it, or a number is one instruction of three
                           operands then (H200: 0.96 without) */
#ifdef SCENE_TREE
    Tree tree;
    __global const SceneTriangle* triangles;
#endif
} Scene;

static inline uint two_sided_spheres(Scene scene) { return scene.count - scene.opaque; }

/* Whether anything in it may be of glass; SCENE_GLASS: a triangle. */
static inline bool scene_refracts(Scene scene) {
#ifdef SCENE_GLASS
    (void)scene;
    return true;
#else
    return two_sided_spheres(scene) > 0u;
#endif
}

/* Numbers of faces, as SceneSurface orders them. */
static inline uint opaque_face(Scene scene, uint sphere) { return 2u * two_sided_spheres(scene) + sphere; }
static inline uint background(Scene scene) { return opaque_face(scene, scene.opaque); }

/* One two-sided sphere among few: the most common scene. */
static inline bool one_is_two_sided(Scene scene) {
#ifdef SCENE_FEW
    return two_sided_spheres(scene) == 1u;
#else
    (void)scene;
    return false;
#endif
}

/* Which two-sided spheres a path is inside: a bit each, from the top. Only transmission changes it. If one of few is
   two-sided, the lowest bit tells so too, which is its face's number. */
typedef struct Sides {
    lanes_u word[SCENE_SIDE_WORDS];
} Sides;

/* Its lowest bit is set inside. A lone word has no number to be looked up by: else a compiler would keep all of the path in
   memory for its sake. */
static inline lanes_u side_of(Scene scene, const Sides* inside, uint number) {
    if (one_is_two_sided(scene)) return inside->word[0];
    return inside->word[SCENE_SIDE_WORDS == 1 ? 0u : number / 32u] >> (31u - number % 32u);
}

/* A float's sign bit inside, else 0; the lowest bit may be set too. */
static inline lanes_u side_sign(Scene scene, lanes_u side) { return one_is_two_sided(scene) ? side : side << 31; }

/* The mask in place of 1 makes one instruction of it and hit_offer's. */
static inline lanes_u two_sided_face(Scene scene, uint number, lanes_u side) {
    return (lanes_u)(2u * number) | (side & (one_is_two_sided(scene) ? ~scene.distance_mask : 1u));
}

/* The lanes between whose sides a two-sided sphere is. */
static inline lanes_mask sides_differ(const Sides* a, const Sides* b) {
    lanes_mask differ = a->word[0] != b->word[0];
    for (uint i = 1; i < SCENE_SIDE_WORDS; ++i) differ |= a->word[i] != b->word[i];
    return differ;
}

/* Passes through a face of each lane's own. */
static inline void change_sides(Scene scene, Sides* inside, lanes_u face, lanes_mask through) {
    if (one_is_two_sided(scene)) {
        inside->word[0] ^= lanes_select_u((lanes_u)(0u), (lanes_u)(SCENE_LONE_SIDE), through);
        return;
    }
    const lanes_u number = face >> 1;
    const lanes_u bit = (lanes_u)(0x80000000u) >> (number & 31u);
    for (uint i = 0; i < SCENE_SIDE_WORDS; ++i) {
        const lanes_mask here = SCENE_SIDE_WORDS == 1 ? through : through & ((number >> 5) == (lanes_u)(i));
        inside->word[i] ^= lanes_select_u((lanes_u)(0u), bit, here);
    }
}

typedef struct Ray {
    Vec origin, direction; /* the direction has length 1 */
#ifdef SCENE_CARRIED
    lanes_f gap[SCENE_FEW]; /* see scene/hit.h */
#endif
#ifdef SCENE_TREE
    uint left;    /* the triangle that it starts at, which it does not meet; or TREE_NOTHING */
    Vec normal;   /* of that triangle, outwards, and */
    float margin; /* how far from its plane, towards where it came from, the ray was put */
    bool passed;  /* whether the last bounce, in a scene that refracts, went through the surface */
#endif
} Ray;

#endif
