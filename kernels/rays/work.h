/* What a ray of a list costs beside its search: bytes of global memory. */
#ifndef PTB_RAYS_WORK_H
#define PTB_RAYS_WORK_H

#include "scene/work.h"
#include "shared/rays.h"

#define RAYS_RAY_WORK 0u, 0u, 0u, (uint)(sizeof(ListedRay) + sizeof(ListedHit))
/* The triangle's number. */
#if SCENE_TREE == 8
#define RAYS_MET_WORK 0u, 0u, 0u, 4u
#else
#define RAYS_MET_WORK 0u, 0u, 0u, 16u
#endif

#endif
