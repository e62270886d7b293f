/* A tree of two children a node, and leaves whose triangles are met one by one: for GPUs, where loads count: each lane's is one
   of its own, however wide. */
#ifndef PTB_SCENE_TREE2_H
#define PTB_SCENE_TREE2_H

#ifdef TREE_QUANTISED

/* A plane of a box on the ray's grid: which 16 bits of a word say its number, as the selector of one byte permutation or as a
   shift. */
typedef uint PlaneSide;
#if PTB_PTX
#define PLANE_LOW 0x7104u
#define PLANE_HIGH 0x7324u
#else
#define PLANE_LOW 0u
#define PLANE_HIGH 16u
#endif

static inline float plane_of(uint planes, PlaneSide side) {
#if PTB_PTX
    uint bits;
    __asm__("prmt.b32 %0, %1, %2, %3;" : "=r"(bits) : "r"(planes), "r"(TREE_PLANE), "r"(side));
    return as_float(bits);
#else
    return as_float(TREE_PLANE | (planes >> side & 0xffffu) << 8);
#endif
}

static inline PlaneSide other_side(PlaneSide side) { return side ^ PLANE_LOW ^ PLANE_HIGH; }
static inline PlaneSide side_met(float inverse) { return inverse < 0.0f ? PLANE_HIGH : PLANE_LOW; }

#endif

struct Search {
    Vec origin, inverse; /* 1 / direction, of grid coordinates with TREE_QUANTISED */
#ifdef TREE_QUANTISED
    Vec enter, leave; /* a plane's coordinate times the inverse, and this, is the distance of one where a box begins or ends */
    PlaneSide begin_x, begin_y, begin_z; /* which of a box's planes that one is */
#else
    Vec minus_start;  /* the origin times -1 / direction */
    Vec inverse_size; /* without the signs of inverse */
#endif
    Vec across, down, direction;      /* a corner's sheared coordinates are its products with the first two, */
    float minus_across, minus_down;   /* less the origin's */
    Found found;
    uint left, target;
    uint at, height;
};

struct SearchStack {
    uint link[TREE_STACK]; /* the host says how many there may be */
};

/* A row of the shear: the coordinate on one axis, less its share of that along the ray. All but one product are exact. */
static inline Vec shear_row(uint axis, uint along, float share) {
    return vec(axis == 0u ? 1.0f : along == 0u ? -share : 0.0f, axis == 1u ? 1.0f : along == 1u ? -share : 0.0f,
               axis == 2u ? 1.0f : along == 2u ? -share : 0.0f);
}

static inline float vec_part(Vec v, uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }

static inline void search_aim(Tree tree, Search* s, Vec origin, Vec direction) {
    const uint along = main_axis(direction), across = along == 2u ? 0u : along + 1u, down = along == 0u ? 2u : along - 1u;
    const float inverse = 1.0f / vec_part(direction, along);
    s->origin = origin;
    s->direction = direction;
    s->inverse = vec(1.0f / steep(direction.x), 1.0f / steep(direction.y), 1.0f / steep(direction.z));
#ifdef TREE_QUANTISED
    s->inverse = vec_mul(s->inverse, vec_of(tree.grid.cell));
    const Vec start = vec_mul_add(vec_of((float4)(0.5f)), vec_sub(origin, vec_of(tree.grid.low)), vec_of(tree.grid.cells));
    const Vec minus_start = vec(-start.x * s->inverse.x, -start.y * s->inverse.y, -start.z * s->inverse.z);
    const Vec room = vec(tree.grid.room.x * fabs(s->inverse.x), tree.grid.room.y * fabs(s->inverse.y),
                         tree.grid.room.z * fabs(s->inverse.z));
    s->enter = vec_sub(minus_start, room);
    s->leave = vec(minus_start.x + room.x, minus_start.y + room.y, minus_start.z + room.z);
    s->begin_x = side_met(s->inverse.x);
    s->begin_y = side_met(s->inverse.y);
    s->begin_z = side_met(s->inverse.z);
#else
    (void)tree;
    s->inverse_size = vec(fabs(s->inverse.x), fabs(s->inverse.y), fabs(s->inverse.z));
    s->minus_start = vec(-origin.x * s->inverse.x, -origin.y * s->inverse.y, -origin.z * s->inverse.z);
#endif
    s->across = shear_row(across, along, vec_part(direction, across) * inverse);
    s->down = shear_row(down, along, vec_part(direction, down) * inverse);
    s->minus_across = -vec_dot(s->across, origin);
    s->minus_down = -vec_dot(s->down, origin);
}

/* Below all that waits lies the end. */
static inline void search_start(Search* s, SearchStack* stack) {
    stack->link[0] = SEARCH_OVER;
    s->height = 1u;
    s->at = 0u;
}

static inline void search_pop(Search* s, const SearchStack* stack) { s->at = stack->link[--s->height]; }

/* Whether the ray goes through a box before what it has found, and where it enters. */
static inline bool enters(const Search* s, Vec near, Vec far, float* entry) {
    *entry = QUICK_MAX(QUICK_MAX(near.x, near.y), QUICK_MAX(near.z, 0.0f));
    return *entry <= QUICK_MIN(QUICK_MIN(far.x, far.y), QUICK_MIN(far.z, s->found.distance));
}

#ifdef TREE_QUANTISED
static inline bool enters_box(const Search* s, uint x, uint y, uint z, float* entry) {
    const Vec begin = vec(plane_of(x, s->begin_x), plane_of(y, s->begin_y), plane_of(z, s->begin_z));
    const Vec end = vec(plane_of(x, other_side(s->begin_x)), plane_of(y, other_side(s->begin_y)), plane_of(z, other_side(s->begin_z)));
    return enters(s, vec_mul_add(s->enter, begin, s->inverse), vec_mul_add(s->leave, end, s->inverse), entry);
}
#else
static inline bool enters_box(const Search* s, float4 centre, float4 half_edges, float* entry) {
    const Vec middle = vec_mul_add(s->minus_start, vec_of(centre), s->inverse), reach = vec_of(half_edges);
    const Vec size = s->inverse_size, far = vec_mul_add(middle, reach, size);
    const Vec near = vec(middle.x - reach.x * size.x, middle.y - reach.y * size.y, middle.z - reach.z * size.z);
    return enters(s, near, far, entry);
}
#endif

/* Goes to the nearer child that the ray enters, and keeps the other for later. */
static inline void search_node(Tree tree, Search* s, SearchStack* stack COUNTED_PARAMETER) {
    COUNTED(1u, TREE_NODE_WORK)
    COUNTED_STEPS(PTB_COUNTED_NODES, 1u)
    float entry0, entry1;
#ifdef TREE_QUANTISED
    __global const uint4* node = (__global const uint4*)tree.nodes + (size_t)s->at * 2u;
    const uint4 box0 = node[0], box1 = node[1];
    const bool first = enters_box(s, box0.x, box0.y, box0.z, &entry0), second = enters_box(s, box1.x, box1.y, box1.z, &entry1);
    const uint link0 = box0.w, link1 = box1.w;
#else
    __global const float4* node = tree.nodes + (size_t)s->at * 4u;
    const float4 centre0 = node[0], half0 = node[1], centre1 = node[2], half1 = node[3];
    const bool first = enters_box(s, centre0, half0, &entry0), second = enters_box(s, centre1, half1, &entry1);
    const uint link0 = as_uint(centre0.w), link1 = as_uint(centre1.w);
#endif
    const bool second_first = second & (!first | (entry1 < entry0));
    s->at = second_first ? link1 : link0;
    if (first & second) stack->link[s->height++] = second_first ? link0 : link1;
    if (!(first | second)) search_pop(s, stack);
}

/* A corner as the ray sees it: of the same bits in all triangles that have it. */
static inline Corner corner_seen(const Search* s, Vec corner) {
#pragma OPENCL FP_CONTRACT OFF
    Corner seen;
#if PTB_PTX || defined(FP_FAST_FMAF)
    seen.x = fma(s->across.z, corner.z, fma(s->across.y, corner.y, fma(s->across.x, corner.x, s->minus_across)));
    seen.y = fma(s->down.z, corner.z, fma(s->down.y, corner.y, fma(s->down.x, corner.x, s->minus_down)));
#else
    seen.x = s->across.x * corner.x + s->across.y * corner.y + s->across.z * corner.z + s->minus_across;
    seen.y = s->down.x * corner.x + s->down.y * corner.y + s->down.z * corner.z + s->minus_down;
#endif
    return seen;
}

/* Meets the triangle at this place. Returns whether it is the nearest now. */
static inline bool search_triangle(Tree tree, Search* s, uint place COUNTED_PARAMETER) {
    COUNTED(1u, TREE_TRIANGLE_WORK)
    COUNTED_STEPS(PTB_COUNTED_TRIANGLES, 1u)
    __global const float4* corners = tree.leaves + (size_t)place * 3u;
    const float4 a_number = corners[0];
    const Vec a = vec_of(a_number), b = vec_of(corners[1]), c = vec_of(corners[2]);
    const Edges edges = edges_of(corner_seen(s, a), corner_seen(s, b), corner_seen(s, c));
    const uint number = as_uint(a_number.w);
    if (!goes_through(&edges) | (number == s->left) | (number == s->target)) return false;
    COUNTED(1u, TREE_POINT_WORK)
    const float inverse = 1.0f / edges.sum, share_b = edges.b * inverse, share_c = edges.c * inverse;
    const Vec to_a = vec_sub(a, s->origin), in_b = vec_add_scaled(to_a, vec_sub(b, a), share_b);
    const Vec to_point = vec_add_scaled(in_b, vec_sub(c, a), share_c);
    const float distance = vec_dot(to_point, s->direction);
    if (!((distance > 0.0f) & (distance < s->found.distance))) return false;
    s->found.distance = distance;
    s->found.place = place;
    s->found.b = share_b;
    s->found.c = share_c;
    return true;
}

static inline void search_leaf(Tree tree, Search* s, const SearchStack* stack, const bool any COUNTED_PARAMETER) {
    const uint run = s->at & ~TREE_LEAF, first = run / TREE_LEAF_MOST, last = first + run % TREE_LEAF_MOST;
    for (uint place = first; place <= last; ++place) {
        if (search_triangle(tree, s, place COUNTED_ARGUMENT) && any) {
            s->at = TREE_NOTHING;
            return;
        }
    }
    search_pop(s, stack);
}

static inline uint triangle_number(Tree tree, uint place) { return as_uint(tree.leaves[3u * place].w); }

/* Corners of the triangle at a place, and its number in the scene. */
static inline uint triangle_at(Tree tree, uint place, Vec corner[3]) {
    __global const float4* corners = tree.leaves + 3u * place;
    const float4 a_number = corners[0];
    corner[0] = vec_of(a_number);
    corner[1] = vec_of(corners[1]);
    corner[2] = vec_of(corners[2]);
    return as_uint(a_number.w);
}

#endif
