/* A ray's search for what it meets in a tree of triangles, which can be left and gone on with. */
#ifndef PTB_SCENE_SEARCH_H
#define PTB_SCENE_SEARCH_H

#include "scene/triangle.h"
#include "scene/work.h"

/* The nearest triangle so far. */
typedef struct Found {
    float distance;
    uint place; /* in the leaves; TREE_NOTHING: none */
    float b, c; /* shares of its second and third corner in the point met */
} Found;

#define SEARCH_OVER TREE_NOTHING /* a link that ends a search */

typedef struct Search Search;

/* What waits while a link is followed. By itself: a compiler keeps no part of a struct in registers that holds an array which
   numbers lead into. */
typedef struct SearchStack SearchStack;

#if SCENE_TREE == 8
#include "scene/tree8.h"
#else
#include "scene/tree2.h"
#endif

/* Of one that was of use: a lane may begin its next one before it knows that there is no work left. */
#define COUNTED_SEARCH COUNTED(1u, TREE_AIM_WORK) COUNTED_STEPS(PTB_COUNTED_SEARCHES, 1u)

/* Begins one within `distance`, of triangles that are not of these two numbers. */
static inline void search_begin(Tree tree, Search* s, SearchStack* stack, Vec origin, Vec direction, float distance, uint left,
                                uint target COUNTED_PARAMETER) {
    COUNTED_UNUSED
    search_aim(tree, s, origin, direction);
    s->found.distance = distance;
    s->found.place = TREE_NOTHING;
    s->found.b = s->found.c = 0.0f;
    s->left = left;
    s->target = target;
    search_start(s, stack);
}

static inline bool search_is_at_node(const Search* s) { return (s->at & TREE_LEAF) == 0u; }
static inline bool search_is_over(const Search* s) { return s->at == SEARCH_OVER; }

/* Lanes of a warp do not search equally long. Those that are done wait until there are SEARCH_DONE of them, and those in
   leaves until fewer than SEARCH_AT_NODES go on through nodes. Either number is held against the lanes that are here, which
   need not be all: a warp may have been split. */
#define SEARCH_DONE 11u
#define SEARCH_AT_NODES 14u

static inline bool search_leaves_nodes(void) {
#if PTB_PTX
    return popcount(warp_here()) < SEARCH_AT_NODES;
#else
    return false;
#endif
}

static inline bool search_pauses(bool over) {
#if PTB_PTX
    uint here, done;
    __asm__ volatile(
        "{\n\t.reg .pred over;\n\tsetp.ne.u32 over, %2, 0;\n\tactivemask.b32 %0;\n\t"
        "vote.sync.ballot.b32 %1, over, %0;\n\t}"
        : "=&r"(here), "=&r"(done)
        : "r"((uint)over));
    return popcount(done) >= min(SEARCH_DONE, popcount(here));
#else
    return over;
#endif
}

/* Goes on; returns whether the search is over. What it finds does not depend on when it was left. `any`: up to the first
   triangle. */
static inline bool search_some(Tree tree, Search* s, SearchStack* stack, bool any COUNTED_PARAMETER) {
    do {
        while (search_is_at_node(s)) {
            search_node(tree, s, stack COUNTED_ARGUMENT);
            if (search_leaves_nodes()) break;
        }
        if (!search_is_at_node(s) && !search_is_over(s)) search_leaf(tree, s, stack, any COUNTED_ARGUMENT);
    } while (!search_pauses(search_is_over(s)));
    return search_is_over(s);
}

/* The whole of it. */
static inline void search_all(Tree tree, Search* s, SearchStack* stack, const bool any COUNTED_PARAMETER) {
    while (!search_is_over(s)) {
        while (search_is_at_node(s)) search_node(tree, s, stack COUNTED_ARGUMENT);
        if (!search_is_over(s)) search_leaf(tree, s, stack, any COUNTED_ARGUMENT);
    }
}

#endif
