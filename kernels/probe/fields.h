/* Every field of every struct that host and device share: S(struct) begins one, F(struct, field) follows in order. Read
   by kernels/probe/layout.cl and by the test that compares its answer with the host's compiler. */
#ifndef PTB_PROBE_FIELDS_H
#define PTB_PROBE_FIELDS_H

#include "shared/pt.h"
#include "shared/thesis.h"

#define PTB_SHARED_FIELDS(S, F)                                                                       \
    S(PtbCamera) F(PtbCamera, position) F(PtbCamera, corner) F(PtbCamera, step_x) F(PtbCamera, step_y) \
    S(PtSphere) F(PtSphere, centre_k)                                                                 \
    S(PtSurface) F(PtSurface, centre_matte) F(PtSurface, weight_eta) F(PtSurface, radiance)           \
    F(PtSurface, traits) F(PtSurface, padding)                                                        \
    S(PtFewSpheres) F(PtFewSpheres, sphere) S(PtStart) F(PtStart, position_side) F(PtStart, gap)      \
    F(PtStart, distance_mask)                                                                         \
    S(PtLaunch) F(PtLaunch, camera) F(PtLaunch, width) F(PtLaunch, inverse_width)                     \
    F(PtLaunch, first_pixel) F(PtLaunch, pixels) F(PtLaunch, inverse_pixels) F(PtLaunch, first_run)   \
    F(PtLaunch, units) F(PtLaunch, path_length) F(PtLaunch, seed)                                     \
    F(PtLaunch, opaque_spheres) F(PtLaunch, two_sided_spheres) F(PtLaunch, units_per_lane)            \
    F(PtLaunch, first_unit) F(PtLaunch, slice)                                                        \
    F(PtLaunch, strata_columns) F(PtLaunch, stratum_width) F(PtLaunch, stratum_height)                \
    F(PtLaunch, padding)                                                                              \
    S(PtTally) F(PtTally, radiance) F(PtTally, squares) F(PtTally, samples) F(PtTally, segments)      \
    F(PtTally, full_length_paths) F(PtTally, padding)                                                 \
    S(ThesisMaterial) F(ThesisMaterial, colour) F(ThesisMaterial, radiance) F(ThesisMaterial, type)   \
    F(ThesisMaterial, ior) F(ThesisMaterial, scatters) F(ThesisMaterial, padding)                     \
    S(ThesisSphere) F(ThesisSphere, centre_radius) F(ThesisSphere, material)                          \
    S(ThesisLaunch) F(ThesisLaunch, camera) F(ThesisLaunch, width) F(ThesisLaunch, first_pixel)       \
    F(ThesisLaunch, pixels) F(ThesisLaunch, samples) F(ThesisLaunch, spp) F(ThesisLaunch, path_length) \
    F(ThesisLaunch, sphere_count) F(ThesisLaunch, padding)

#endif
