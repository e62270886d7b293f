/* `pt_nee`: `pt` with next-event estimation. */
#define PATH_ASKS
#include "pt_nee/segment.h"

static inline lanes_mask trace_segment(const World* world, Path* path, const Hit* hit, lanes_mask alive,
                                       uint turn COUNTED_PARAMETER) {
    return trace_asking(world, path, hit, alive, turn COUNTED_ARGUMENT);
}

#define INTEGRATOR pt_nee
#include "engine/trace.h"
#include "engine/kernels.h"
