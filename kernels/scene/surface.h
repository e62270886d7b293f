/* What a face is made of, looked up per lane. */
#ifndef PTB_SCENE_SURFACE_H
#define PTB_SCENE_SURFACE_H

#include "lib/table.h"
#include "scene/meet.h"

/* See SceneSurface. */
typedef struct Surface {
    Vec centre;
    lanes_f matte;
    Vec weight;
    lanes_f eta_squared, less_eta_squared; /* the latter is 1 - eta^2 */
    lanes_f mirrored, before, beyond;      /* outwards eta, outwards / eta */
} Surface;

/* How a lane reaches its own row: with few spheres the rows lie in registers, a table a field, and one permute serves all
   lanes of a register (two AVX-512 cores, PoCL: 14.0 Msamples/s, 9.2 with the loads and roots of the portable form, 7.1
   with chains of selects); else every lane loads its row from memory. */
#if defined(SCENE_FEW) && TABLE_PERMUTES

/* Of many lamps a path asks which one it met. */
#ifdef SCENE_MANY_LAMPS
#define SURFACE_FIELDS 15
#else
#define SURFACE_FIELDS 14
#endif

typedef struct Surfaces {
    Table field[SURFACE_FIELDS];
} Surfaces;

static inline Surfaces surfaces_of(SCENE_SURFACE_SPACE const SceneSurface* rows, uint faces) {
    Surfaces s;
    for (uint i = 0; i < TABLE_ROWS; ++i) {
        const SceneSurface row = rows[min(i, faces)];
        s.field[0].row[i] = row.centre_matte.x;
        s.field[1].row[i] = row.centre_matte.y;
        s.field[2].row[i] = row.centre_matte.z;
        s.field[3].row[i] = row.centre_matte.w;
        s.field[4].row[i] = row.weight_eta.x;
        s.field[5].row[i] = row.weight_eta.y;
        s.field[6].row[i] = row.weight_eta.z;
        s.field[7].row[i] = row.weight_eta.w;
        s.field[8].row[i ^ 1] = row.radiance.x;
        s.field[9].row[i ^ 1] = row.radiance.y;
        s.field[10].row[i ^ 1] = row.radiance.z;
        s.field[11].row[i] = row.traits.x;
        s.field[12].row[i] = row.traits.y;
        s.field[13].row[i] = row.traits.z;
#ifdef SCENE_MANY_LAMPS
        s.field[14].row[i] = row.radiance.w;
#endif
    }
    return s;
}
#define SURFACE_FIELD(surfaces, number, member, index) table_lookup(&(surfaces)->field[number], index)
/* LLVM knows a permute only where its index is made in the same block; radiances are read in a later one, so they lie in
   another order and have an index of their own. */
#define RADIANCE_INDEX(face) ((face) ^ 1u)
#define SURFACE_LESS_ETA_SQUARED(surfaces, eta_squared, index) (1.0f - (eta_squared)) /* is less than a lookup */

#else

typedef struct Surfaces {
    SCENE_SURFACE_SPACE const SceneSurface* rows;
} Surfaces;

static inline Surfaces surfaces_of(SCENE_SURFACE_SPACE const SceneSurface* rows, uint faces) {
    Surfaces s;
    (void)faces;
    s.rows = rows;
    return s;
}
#define SURFACE_FIELD(surfaces, number, member, index) LANES_GATHER(float, (surfaces)->rows, index, .member)
#define RADIANCE_INDEX(face) (face)
#define SURFACE_LESS_ETA_SQUARED(surfaces, eta_squared, index) LANES_GATHER(float, (surfaces)->rows, index, .traits.w)

#endif

ALWAYS_INLINE Surface surface_of(const Surfaces* all, lanes_u face) {
    Surface s;
    s.centre.x = SURFACE_FIELD(all, 0, centre_matte.x, face);
    s.centre.y = SURFACE_FIELD(all, 1, centre_matte.y, face);
    s.centre.z = SURFACE_FIELD(all, 2, centre_matte.z, face);
    s.matte = SURFACE_FIELD(all, 3, centre_matte.w, face);
    s.weight.x = SURFACE_FIELD(all, 4, weight_eta.x, face);
    s.weight.y = SURFACE_FIELD(all, 5, weight_eta.y, face);
    s.weight.z = SURFACE_FIELD(all, 6, weight_eta.z, face);
    s.eta_squared = SURFACE_FIELD(all, 7, weight_eta.w, face);
    s.less_eta_squared = SURFACE_LESS_ETA_SQUARED(all, s.eta_squared, face);
    s.mirrored = SURFACE_FIELD(all, 11, traits.x, face);
    s.before = SURFACE_FIELD(all, 12, traits.y, face);
    s.beyond = SURFACE_FIELD(all, 13, traits.z, face);
    return s;
}

/* Radiance that the face sends out. */
ALWAYS_INLINE Vec radiance_of(const Surfaces* all, lanes_u face) {
    const lanes_u index = RADIANCE_INDEX(face);
    return vec(SURFACE_FIELD(all, 8, radiance.x, index), SURFACE_FIELD(all, 9, radiance.y, index),
               SURFACE_FIELD(all, 10, radiance.z, index));
}

#ifdef SCENE_TREE
/* The density by area with which a point of its triangles is asked for light, or 0. */
static inline float density_asked(const Surfaces* all, uint face) { return SURFACE_FIELD(all, 0, asked.x, face); }
#endif

#ifdef SCENE_MANY_LAMPS
/* Its lamp's number and 1, or 0. */
static inline lanes_u lamp_of_face(const Surfaces* all, lanes_u face) {
    return lanes_to_u(SURFACE_FIELD(all, 14, radiance.w, face));
}
#endif

#endif
