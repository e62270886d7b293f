/* The arithmetic of its own steps, for the build that counts; see bdpt/work.h and engine/work.h. */
#ifndef PTB_PT_LT_WORK_H
#define PTB_PT_LT_WORK_H

#include "bdpt/work.h"

/* The odds at a lamp; those of a camera path's first segment, and where there is glass; a vertex that is shown. */
#define PT_LT_START_WORK 1u, 0u, 0u, 0u
#define PT_LT_FIRST_WORK 19u, 0u, 1u, 0u
#define PT_LT_GLASS_WORK 1u, 0u, 0u, 0u
#define PT_LT_VERTEX_WORK 7u, 0u, 0u, 0u

#endif
