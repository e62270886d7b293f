/* The arithmetic of each step of `thesis`, for the build that counts: additions and multiplications, roots, divisions,
   and bytes of global memory. Held against the instructions that Oclgrind sees by tests/render/counted.py. */
#ifndef PTB_THESIS_WORK_H
#define PTB_THESIS_WORK_H

#include "lib/counted.h"

/* Numbers of a float4, whether or not the fourth is of use: the thesis computes it. 1 counts vectors' instructions. */
#ifndef THESIS_WIDTH
#define THESIS_WIDTH 4u
#endif
#define THESIS_DOT 7u

/* The state read and written, and the division by the modulus. */
#define THESIS_RANDOM_WORK 0u, 0u, 1u, 8u
/* The difference, three scalar products, r^2 and the discriminant. */
#define THESIS_TEST_WORK (THESIS_WIDTH + 3u * THESIS_DOT + 2u + 3u), 0u, 0u, 16u
#define THESIS_ROOT_WORK 1u, 1u, 1u, 0u
/* The point and the normal, and the material copied. */
#define THESIS_HIT_WORK (3u * THESIS_WIDTH), 0u, THESIS_WIDTH, 48u
#define THESIS_GATHER_WORK (2u * THESIS_WIDTH), 0u, 0u, 0u
#define THESIS_WEIGHT_WORK THESIS_WIDTH, 0u, 0u, 0u
/* The point of the cube, normalised, and its side. */
#define THESIS_MATTE_WORK (6u + THESIS_DOT + THESIS_WIDTH + THESIS_DOT), 1u, 1u, 0u
#define THESIS_REFLECTION_WORK (THESIS_DOT + 1u + 2u * THESIS_WIDTH), 0u, 0u, 0u
/* The side, the cosine and k; 1 / index. */
#define THESIS_DIELECTRIC_WORK (2u * THESIS_DOT + 5u), 0u, 0u, 0u
#define THESIS_ENTERING_WORK 0u, 0u, 1u, 0u
#define THESIS_SCHLICK_WORK (2u + 1u + 1u + 7u), 0u, 1u, 0u
#define THESIS_REFRACTION_WORK (2u + 3u * THESIS_WIDTH), 1u, 0u, 0u
/* The camera ray, and the sample added to the pixel. */
#define THESIS_SAMPLE_WORK (2u + 4u * THESIS_WIDTH + 2u * THESIS_WIDTH), 0u, 1u, 32u

#endif
