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

/* The way back: a direction d from the camera, of length 1, goes through image position (across.d / axis.d + its w,
   down.d / axis.d + its w). */
typedef struct PtbPicture {
    ptb_float4 axis_area; /* xyz: along the view, of length 1; w: area of the picture at distance 1 */
    ptb_float4 across;
    ptb_float4 down;
} PtbPicture;
PTB_ASSERT_SIZE(PtbPicture, 48);

#endif
