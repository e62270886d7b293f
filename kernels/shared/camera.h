/* Pinhole camera: the primary ray through image position (x, y), in pixels from the top left corner, has the
   direction `corner + x * step_x + y * step_y`; `corner` is the direction through the top left corner. */
#ifndef PTB_SHARED_CAMERA_H
#define PTB_SHARED_CAMERA_H

#include "shared/types.h"

typedef struct PtbCamera {
    ptb_float4 position;
    ptb_float4 corner;
    ptb_float4 step_x; /* one pixel to the right */
    ptb_float4 step_y; /* one pixel down */
} PtbCamera;
PTB_ASSERT_SIZE(PtbCamera, 64);

#endif
