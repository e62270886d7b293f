/* With ENGINE_COST, in a build that counts, a picture shows what samples took in place of what they are worth: nodes, triangles
   and rays of a tree's search. A sample's are whole numbers that floats hold, so their sums are those of the counts. */
#ifndef PTB_ENGINE_COST_H
#define PTB_ENGINE_COST_H

#ifdef ENGINE_COST

/* What a lane's searches took when its last sample ended. */
typedef struct Spent {
    ulong nodes, triangles, rays;
} Spent;

static inline Vec spent_since(Spent* then, const ulong* counted) {
    const Spent now = {counted[PTB_COUNTED_NODES], counted[PTB_COUNTED_TRIANGLES], counted[PTB_COUNTED_SEARCHES]};
    const Vec spent = vec((float)(now.nodes - then->nodes), (float)(now.triangles - then->triangles), (float)(now.rays - then->rays));
    *then = now;
    return spent;
}

#define SPENT_NOTHING Spent spent = {0ul, 0ul, 0ul};
#define SAMPLE_SHOWN(world, path, face) spent_since(&spent, counted)

#else

#define SPENT_NOTHING
#define SAMPLE_SHOWN(world, path, face) gathered_radiance(world, path, face)

#endif
#endif
