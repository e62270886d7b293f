/* The scene as kernels that share the engine see it; the host makes it in core/integrator/device_scene. */
#ifndef PTB_SHARED_SCENE_H
#define PTB_SHARED_SCENE_H

#include "shared/camera.h"
#include "shared/tree.h"

/* A sphere as the intersection wants it. */
typedef struct SceneSphere {
    ptb_float4 centre_k; /* xyz: centre; w: |centre|^2 - radius^2, or radius^2 of a distant one: see scene/hit.h; all
                            rounded once from double, from an origin of the device's own */
} SceneSphere;
PTB_ASSERT_SIZE(SceneSphere, 16);

/* What a lone two-sided sphere among few has in its word of sides inside: see scene/scene.h. */
#define SCENE_LONE_SIDE 0x80000001u

/* Spheres of so few faces are passed by value and known one by one while compiling; one row more is the background. */
#define SCENE_FEW_MOST 15

/* The bits of a distance that are kept where a face's number is put into the others. */
#define SCENE_DISTANCE_MASK 0xfffffff0u

typedef struct SceneFewSpheres {
    SceneSphere sphere[SCENE_FEW_MOST + 1];
} SceneFewSpheres;
PTB_ASSERT_SIZE(SceneFewSpheres, 256);

/* What scattering needs to know of a face of a sphere. Rows: the outer and the inner face of each two-sided sphere, the
   one face of each opaque one, the background; after the start, the outer and the inner face of the triangles of each
   material. `outwards` is 1 / radius, negative on an inner face: times the way from the centre, the normal on this side.
   Triangles' are 1 and -1, times the normal. `eta` is the index of refraction here over that beyond. */
typedef struct SceneSurface {
    ptb_float4 centre_matte; /* xyz: centre; w: outwards if matte, else 0 */
    ptb_float4 weight_eta;   /* rgb: throughput factor of a bounce; w: eta^2, NaN unless dielectric, so that nothing
                                goes through */
    ptb_float4 radiance;     /* rgb: emitted; w: its lamp's number and 1, or 0 */
    ptb_float4 traits;       /* x: 2 / radius^2 of a mirror or dielectric, 0 if matte, -1 if no path goes on from it;
                                y: outwards eta; z: outwards / eta; w: 1 - eta^2 */
    ptb_float4 asked;  /* x: of triangles that shine, the density by area with which a lamp's point is asked for. Rows of 80
                          bytes lie in different banks of a GPU's local memory, rows of 64 in two of them */
} SceneSurface;
PTB_ASSERT_SIZE(SceneSurface, 80);

/* What all paths start with; one more row of the surfaces. */
typedef struct SceneStart {
    ptb_float4 position_side; /* xyz: of the camera; w: bits of the first word of the sides that it is on */
    float gap[SCENE_FEW_MOST]; /* of few spheres: radius^2 - |camera - centre|^2, rounded once from double */
    ptb_uint distance_mask;    /* SCENE_DISTANCE_MASK */
} SceneStart;
PTB_ASSERT_SIZE(SceneStart, 80);

/* What a path needs to know of a triangle of the scene, by its number. */
typedef struct SceneTriangle {
    ptb_float4 normal_face; /* xyz: of length 1, outwards; w: bits of the number of its outer face, before that of the inner one */
} SceneTriangle;
PTB_ASSERT_SIZE(SceneTriangle, 16);

/* What SceneLamp::face has of a triangle, beside its number. */
#define SCENE_TRIANGLE 0x80000000u

/* A sphere that shines and can be sampled: see scene/lamps.h. Of N lamps, lamp number i is chosen by a uniform number in
   [i, i + 1) / N below (i + kept) / N, else its alias is. A triangle is one of radius 0, of which these are said to be of
   both: radiance, kept, chance, the density, alias, face, middle. */
typedef struct SceneLamp {
    ptb_float4 centre_radius;
    ptb_float4 axis_extent;   /* xyz: to the middle of the cap that shows; w: 1 - cosine of the cap's rim, seen from the centre */
    ptb_float4 radiance_kept; /* rgb: sent out; w: share of a choice of this number that stays with it */
    ptb_float4 middle_sent;   /* xyz: the point that stands for the lamp; w: area / 4 of a whole sphere, / 2 of a cap */
    float chance;             /* that the lamp is chosen */
    float cap_density;        /* chance / area of the cap */
    float near_squared;       /* points whose squared distance from the centre is below sample the sphere as they see it, others
                                 the cap; a lamp that hangs free has no cap: infinity */
    ptb_uint alias;
    ptb_uint face;  /* its number, as the rows of surfaces have it */
    ptb_uint place; /* of a triangle in the leaves */
    ptb_uint padding[2];
} SceneLamp;
PTB_ASSERT_SIZE(SceneLamp, 96);

/* What SCENE_LONE_LAMP says of it. */
#define SCENE_FREE_LAMP 1
#define SCENE_SUNK_LAMP 2

/* Where spheres and surfaces lie that rays read: SCENE_SPHERES and SCENE_SURFACES. */
#define SCENE_IN_ARGUMENT 0
#define SCENE_IN_CONSTANT 1
#define SCENE_IN_GLOBAL 2
#define SCENE_IN_LOCAL 3
#define SCENE_IN_PRIVATE 4

#endif
