/* A tree of up to eight children a node, and leaves of eight triangles, met all at once: for CPUs, whose registers hold
   eight floats or more. */
#ifndef PTB_SCENE_TREE8_H
#define PTB_SCENE_TREE8_H

#include "lib/bits.h"
#include "lib/fetch.h"

#define NODE_FLOATS 56u
#define BLOCK_FLOATS 80u

static inline __global const float* node_at(Tree tree, uint link) { return (__global const float*)tree.nodes + NODE_FLOATS * link; }
static inline __global const float* block_at(Tree tree, uint number) { return (__global const float*)tree.leaves + BLOCK_FLOATS * number; }

/* Of a tree larger than caches: 1.07 of the speed (1.7 million triangles, one AVX-512 core, PoCL). */
static inline void fetch_link(Tree tree, uint link) {
    if ((link & TREE_LEAF) == 0u)
        fetch_early(node_at(tree, link), 4u * NODE_FLOATS);
    else
        fetch_early(block_at(tree, link & ~TREE_LEAF), 4u * BLOCK_FLOATS);
}

struct Search {
    float start[3];                   /* across, down, and along the ray */
    float inverse[3], minus_start[3]; /* 1 / direction, and the origin times -1 / direction */
    uint entry[3], exit[3];           /* of a node's floats, the planes where the ray enters boxes, and leaves them */
    uint axis[3];                     /* of the shear: across, down, and along the ray */
    float across, down, along;        /* shares of the third coordinate in the others, and distance by it */
    float along_across, along_down;   /* what distance by it lacks where the others are not 0 */
    Found found;
    uint left, target;
    uint at, height;
};

struct SearchStack {
    ulong word[TREE_STACK + 1]; /* of links that wait, and the one to follow: where the ray enters, as bits, and the link: so they are
                                   in order, and one that is behind what was found is dropped unseen */
};

static inline void search_aim(Tree tree, Search* s, Vec origin, Vec direction) {
    (void)tree;
    const float start[3] = {origin.x, origin.y, origin.z}, d[3] = {direction.x, direction.y, direction.z};
    const uint along = main_axis(direction), across = along == 2u ? 0u : along + 1u, down = along == 0u ? 2u : along - 1u;
    for (uint i = 0u; i < 3u; ++i) {
        s->inverse[i] = 1.0f / steep(d[i]);
        s->minus_start[i] = -start[i] * s->inverse[i];
        s->entry[i] = 8u * (as_int(d[i]) < 0 ? i + 3u : i);
        s->exit[i] = 8u * (as_int(d[i]) < 0 ? i : i + 3u);
    }
    s->axis[0] = across;
    s->axis[1] = down;
    s->axis[2] = along;
    for (uint i = 0u; i < 3u; ++i) s->start[i] = start[s->axis[i]];
    s->along = 1.0f / d[along];
    s->across = d[across] * s->along;
    s->down = d[down] * s->along;
    s->along_across = d[across] * d[along];
    s->along_down = d[down] * d[along];
}

/* Eight floats that lie as vectors do. (vload8 is two loads with PoCL.) */
static inline float8 eight_at(__global const float* row) { return *(__global const float8*)row; }

static inline void search_start(Search* s, SearchStack* stack) {
    (void)stack;
    s->height = 0u;
    s->at = 0u;
}

static inline void search_pop(Search* s, const SearchStack* stack) {
    while (s->height > 0u) {
        const ulong word = stack->word[--s->height];
        if (as_float((uint)(word >> 32)) >= s->found.distance) continue;
        s->at = (uint)word;
        return;
    }
    s->at = TREE_NOTHING;
}

/* Where the ray meets planes of eight boxes. */
static inline float8 slab(const Search* s, __global const float* planes, uint axis) {
    return eight_at(planes) * s->inverse[axis] + s->minus_start[axis];
}

/* The next of the children that a ray enters, as a word of the stack. */
static inline ulong take_child(Tree tree, __global const uint* links, const float* entry, uint* entered) {
    const uint child = lowest_bit(*entered), link = links[child];
    *entered &= *entered - 1u;
    fetch_link(tree, link);
    return (ulong)as_uint(entry[child]) << 32 | link;
}

/* Puts the nearer one first. Without a branch, which nothing would foretell. */
static inline void sort_two(ulong* a, ulong* b) {
    const ulong first = min(*a, *b), second = max(*a, *b);
    *a = first;
    *b = second;
}

/* Keeps a child for later, behind nearer ones from `base` on. */
static inline void search_push(Search* s, SearchStack* stack, uint base, ulong word) {
    uint place = s->height++;
    for (; place > base && stack->word[place - 1u] < word; --place) stack->word[place] = stack->word[place - 1u];
    stack->word[place] = word;
}

/* Goes to the nearest child that the ray enters, and keeps the others for later. */
static inline void search_node(Tree tree, Search* s, SearchStack* stack COUNTED_PARAMETER) {
    COUNTED(1u, TREE_NODE_WORK)
    COUNTED_STEPS(PTB_COUNTED_NODES, 1u)
    __global const float* node = node_at(tree, s->at);
    const float8 in_x = slab(s, node + s->entry[0], 0u), out_x = slab(s, node + s->exit[0], 0u);
    const float8 in_y = slab(s, node + s->entry[1], 1u), out_y = slab(s, node + s->exit[1], 1u);
    const float8 in_z = slab(s, node + s->entry[2], 2u), out_z = slab(s, node + s->exit[2], 2u);
    const float8 in = tree_max(tree_max(in_x, in_y), tree_max(in_z, (float8)(0.0f)));
    const float8 out = tree_min(tree_min(out_x, out_y), tree_min(out_z, (float8)(s->found.distance)));
    uint entered = bits_of_mask(in <= out);
    if (entered == 0u) {
        search_pop(s, stack);
        return;
    }
    __global const uint* links = (__global const uint*)(node + 48);
    const uint first = lowest_bit(entered);
    entered &= entered - 1u;
    if (entered == 0u) {
        s->at = links[first];
        return;
    }
    float entry[8];
    vstore8(in, 0, entry);
    ulong a = (ulong)as_uint(entry[first]) << 32 | links[first], b = take_child(tree, links, entry, &entered);
    sort_two(&a, &b);
    if (entered == 0u) {
        s->at = (uint)a;
        stack->word[s->height++] = b;
        return;
    }
    ulong c = take_child(tree, links, entry, &entered);
    sort_two(&b, &c);
    sort_two(&a, &b);
    const uint base = s->height;
    stack->word[s->height++] = c;
    stack->word[s->height++] = b;
    s->at = (uint)a;
    if (entered == 0u) return;
    stack->word[s->height++] = a;
    do search_push(s, stack, base, take_child(tree, links, entry, &entered));
    while (entered != 0u);
    s->at = (uint)stack->word[--s->height];
}

/* x less its share of z. */
static inline float8 sheared(float8 x, float8 z, float share) {
#pragma OPENCL FP_CONTRACT OFF
#ifdef FP_FAST_FMAF
    return fma(-(float8)(share), z, x);
#else
    return x - share * z;
#endif
}

/* One coordinate of a corner, from the ray's origin: across, down, or along the ray. */
static inline float8 from_origin(const Search* s, __global const float* block, uint corner, uint way) {
    return eight_at(block + 24u * corner + 8u * s->axis[way]) - s->start[way];
}

static inline Corner corner_seen(const Search* s, __global const float* block, uint number, float8 z) {
    Corner corner;
    corner.x = sheared(from_origin(s, block, number, 0u), z, s->across);
    corner.y = sheared(from_origin(s, block, number, 1u), z, s->down);
    return corner;
}

/* How far along the ray a corner is, over `along`. In a long thin triangle the point met is not quite on the ray, and so may be nearer
   or farther than where it is seen. */
static inline float8 corner_along(const Search* s, Corner corner, float8 z) {
    return z + s->along_across * corner.x + s->along_down * corner.y;
}

static inline void search_leaf(Tree tree, Search* s, const SearchStack* stack, const bool any COUNTED_PARAMETER) {
    COUNTED(8u, TREE_TRIANGLE_WORK)
    COUNTED_STEPS(PTB_COUNTED_TRIANGLES, 8u)
    const uint number = s->at & ~TREE_LEAF;
    __global const float* block = block_at(tree, number);
    const float8 z0 = from_origin(s, block, 0u, 2u), z1 = from_origin(s, block, 1u, 2u);
    const float8 z2 = from_origin(s, block, 2u, 2u);
    const Corner a = corner_seen(s, block, 0u, z0), b = corner_seen(s, block, 1u, z1), c = corner_seen(s, block, 2u, z2);
    const Edges edges = edges_of(a, b, c);
    const int8 through = goes_through(&edges);
    if (bits_of_mask(through) != 0u) {
        COUNTED(8u, TREE_POINT_WORK)
        const float8 inverse = 1.0f / edges.sum;
        const float8 way = edges.a * corner_along(s, a, z0) + edges.b * corner_along(s, b, z1) + edges.c * corner_along(s, c, z2);
        const float8 distance = way * inverse * s->along;
        const uint8 numbers = vload8(9, (__global const uint*)block);
        const int8 meets = through & (distance > 0.0f) & (distance < s->found.distance) & (numbers != s->left) & (numbers != s->target);
        uint met = bits_of_mask(meets);
        if (met != 0u) {
            float at[8], share_b[8], share_c[8];
            vstore8(distance, 0, at);
            vstore8(edges.b * inverse, 0, share_b);
            vstore8(edges.c * inverse, 0, share_c);
            do {
                const uint i = lowest_bit(met);
                met &= met - 1u;
                if (at[i] < s->found.distance) {
                    s->found.distance = at[i];
                    s->found.place = 8u * number + i;
                    s->found.b = share_b[i];
                    s->found.c = share_c[i];
                }
            } while (met != 0u);
            if (any) {
                s->at = TREE_NOTHING;
                return;
            }
        }
    }
    search_pop(s, stack);
}

static inline uint triangle_number(Tree tree, uint place) { return as_uint(block_at(tree, place / 8u)[72u + place % 8u]); }

/* Corners of the triangle at a place, and its number in the scene. */
static inline uint triangle_at(Tree tree, uint place, Vec corner[3]) {
    __global const float* own = block_at(tree, place / 8u) + place % 8u;
    for (uint i = 0u; i < 3u; ++i) corner[i] = vec(own[24u * i], own[24u * i + 8u], own[24u * i + 16u]);
    return as_uint(own[72]);
}

#endif
