/* Trees over triangles, as kernels walk them; core/tree makes them. */
#ifndef PTB_SHARED_TREE_H
#define PTB_SHARED_TREE_H

#include "shared/types.h"

/* A link leads to an inner node of that number, or, with the bit TREE_LEAF, to a leaf. In a tree of two children a node,
   a leaf is a run of 1 to TREE_LEAF_MOST triangles: its first triangle's number times TREE_LEAF_MOST, plus the count less 1.
   In a tree of eight, a leaf is the block of that number. */
#define TREE_LEAF 0x80000000u
#define TREE_LEAF_MOST 2u
#define TREE_NOTHING 0xffffffffu /* the link of a place without a child, whose box no ray enters */

/* A point of a triangle is put this share of the triangle's largest coordinate from it, on the ray's side: more than rounding
   puts it on the other, and more than boxes are larger than what they hold, so that a ray from a wall along two axes does not
   begin in the box of that wall's own leaf. */
#define TRIANGLE_MARGIN 0x1p-19f

/* An inner node of two children, whose boxes it has: by their centres and halves of their edges, which take a ray six minima and
   maxima fewer a box than corners do. Boxes are so much larger than what they hold that rounding of the ray's way through them
   loses nothing. */
typedef struct TreeNode2 {
    ptb_float4 centre0_link; /* xyz: the first child's centre; w: bits of its link */
    ptb_float4 half0;        /* below 0 where there is no child */
    ptb_float4 centre1_link;
    ptb_float4 half1;
} TreeNode2;
PTB_ASSERT_SIZE(TreeNode2, 64);

/* The same in half the bytes: the planes of both boxes are numbers of the planes of a grid around all triangles, those of a
   box's low corner in the lower 16 bits. Plane number n has the grid coordinate whose bits as a float are
   TREE_PLANE | n << 8, from 0.5 to 2. Where there is no child, low is above high. */
typedef struct TreeNode2q {
    ptb_uint x0, y0, z0, link0;
    ptb_uint x1, y1, z1, link1;
} TreeNode2q;
PTB_ASSERT_SIZE(TreeNode2q, 32);

#define TREE_PLANE 0x3f000000u

/* Where its planes are: grid coordinates are (scene's - low) * cells + 0.5. */
typedef struct TreeGrid {
    ptb_float4 low, cells;
    ptb_float4 cell; /* 1 / cells */
    ptb_float4 room; /* how far outside of its planes a box is met, so that rounding loses nothing */
} TreeGrid;
PTB_ASSERT_SIZE(TreeGrid, 64);

/* A triangle of the leaves of such a tree. */
typedef struct TreeTriangle {
    ptb_float4 a_number; /* xyz: first corner; w: bits of the triangle's number in the scene */
    ptb_float4 b;
    ptb_float4 c;
} TreeTriangle;
PTB_ASSERT_SIZE(TreeTriangle, 48);

/* An inner node of up to eight children, each coordinate of all boxes at once. */
typedef struct TreeNode8 {
    float low[3][8];
    float high[3][8];
    ptb_uint link[8];
} TreeNode8;
PTB_ASSERT_SIZE(TreeNode8, 224);

/* A leaf of such a tree: eight triangles, each coordinate of all of them at once. A place without one has corners that are
   no numbers. */
typedef struct TreeBlock8 {
    float corner[3][3][8]; /* of corner a, b, c: x, y, z */
    ptb_uint number[8];    /* of the triangle in the scene */
} TreeBlock8;
PTB_ASSERT_SIZE(TreeBlock8, 320);

#endif
