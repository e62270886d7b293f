/* What a sphere is made of, looked up per lane. */
#ifndef PTB_PT_SURFACE_H
#define PTB_PT_SURFACE_H

#include "lib/table.h"
#include "pt/hit.h"

typedef struct Surface {
    Vec centre;
    lanes_f inverse_radius;
    Vec weight;               /* throughput factor of a bounce */
    lanes_f ior, inverse_ior; /* NaN: no dielectric */
    lanes_f kind;             /* 0: matte; 1: mirror or dielectric; -1: no path goes on from here */
    lanes_u side;             /* see PtSurface */
} Surface;

/* How a lane reaches its own row: with few spheres the rows lie in registers, a table a field, and one permute serves all
   lanes of a register (two AVX-512 cores, PoCL: 14.0 Msamples/s, 9.2 with the loads and roots of the portable form, 7.1
   with chains of selects); else every lane loads its row from memory. */
#if defined(PT_FEW) && TABLE_PERMUTES

typedef struct Surfaces {
    Table field[14];
} Surfaces;

static inline Surfaces surfaces_of(PT_SURFACE_SPACE const PtSurface* rows, uint count) {
    Surfaces s;
    for (uint i = 0; i < TABLE_ROWS; ++i) {
        const PtSurface row = rows[min(i, count)];
        s.field[0].row[i] = row.centre_inverse_radius.x;
        s.field[1].row[i] = row.centre_inverse_radius.y;
        s.field[2].row[i] = row.centre_inverse_radius.z;
        s.field[3].row[i] = row.centre_inverse_radius.w;
        s.field[4].row[i] = row.weight.x;
        s.field[5].row[i] = row.weight.y;
        s.field[6].row[i] = row.weight.z;
        s.field[7].row[i] = row.weight.w;
        s.field[8].row[i] = row.radiance.x;
        s.field[9].row[i] = row.radiance.y;
        s.field[10].row[i] = row.radiance.z;
        s.field[11].row[i] = row.traits.x;
        s.field[12].row[i] = row.traits.y;
        s.field[13].row[i] = row.traits.w;
    }
    return s;
}
#define SURFACE_FIELD(surfaces, number, member, index) table_lookup(&(surfaces)->field[number], index)

#else

typedef struct Surfaces {
    PT_SURFACE_SPACE const PtSurface* rows;
} Surfaces;

static inline Surfaces surfaces_of(PT_SURFACE_SPACE const PtSurface* rows, uint count) {
    Surfaces s;
    (void)count;
    s.rows = rows;
    return s;
}
#define SURFACE_FIELD(surfaces, number, member, index) LANES_GATHER((surfaces)->rows, index, member)

#endif

static inline Surface surface_of(const Surfaces* all, lanes_u sphere) {
    Surface s;
    s.centre.x = SURFACE_FIELD(all, 0, centre_inverse_radius.x, sphere);
    s.centre.y = SURFACE_FIELD(all, 1, centre_inverse_radius.y, sphere);
    s.centre.z = SURFACE_FIELD(all, 2, centre_inverse_radius.z, sphere);
    s.inverse_radius = SURFACE_FIELD(all, 3, centre_inverse_radius.w, sphere);
    s.weight.x = SURFACE_FIELD(all, 4, weight.x, sphere);
    s.weight.y = SURFACE_FIELD(all, 5, weight.y, sphere);
    s.weight.z = SURFACE_FIELD(all, 6, weight.z, sphere);
    s.ior = SURFACE_FIELD(all, 7, weight.w, sphere);
    s.kind = SURFACE_FIELD(all, 11, traits.x, sphere);
    s.inverse_ior = SURFACE_FIELD(all, 12, traits.y, sphere);
    s.side = lanes_as_u(SURFACE_FIELD(all, 13, traits.w, sphere));
    return s;
}

/* Radiance that the sphere sends out, from both faces. */
static inline Vec radiance_of(const Surfaces* all, lanes_u sphere) {
    return vec(SURFACE_FIELD(all, 8, radiance.x, sphere), SURFACE_FIELD(all, 9, radiance.y, sphere),
               SURFACE_FIELD(all, 10, radiance.z, sphere));
}

#endif
