/* Every field of every struct that host and device share: S(struct) begins one, F(struct, field) follows in order. Read
   by kernels/probe/layout.cl and by the test that compares its answer with the host's compiler. */
#ifndef PTB_PROBE_FIELDS_H
#define PTB_PROBE_FIELDS_H

#include "shared/engine.h"
#include "shared/gradients.h"
#include "shared/thesis.h"

#define PTB_SHARED_FIELDS(S, F)                                                                       \
    S(PtbCamera) F(PtbCamera, position) F(PtbCamera, corner) F(PtbCamera, step_x) F(PtbCamera, step_y) \
    S(PtbPicture) F(PtbPicture, axis_area) F(PtbPicture, across) F(PtbPicture, down)                   \
    S(SceneSphere) F(SceneSphere, centre_k)                                                            \
    S(SceneSurface) F(SceneSurface, centre_matte) F(SceneSurface, weight_eta) F(SceneSurface, radiance) \
    F(SceneSurface, traits) F(SceneSurface, asked)                                                   \
    S(SceneFewSpheres) F(SceneFewSpheres, sphere)                                                      \
    S(SceneStart) F(SceneStart, position_side) F(SceneStart, gap) F(SceneStart, distance_mask)         \
    S(SceneTriangle) F(SceneTriangle, normal_face)                                                     \
    S(TreeNode2) F(TreeNode2, centre0_link) F(TreeNode2, half0) F(TreeNode2, centre1_link) F(TreeNode2, half1) \
    S(TreeNode2q) F(TreeNode2q, x0) F(TreeNode2q, y0) F(TreeNode2q, z0) F(TreeNode2q, link0)           \
    F(TreeNode2q, x1) F(TreeNode2q, y1) F(TreeNode2q, z1) F(TreeNode2q, link1)                         \
    S(TreeGrid) F(TreeGrid, low) F(TreeGrid, cells) F(TreeGrid, cell) F(TreeGrid, room)                \
    S(TreeTriangle) F(TreeTriangle, a_number) F(TreeTriangle, b) F(TreeTriangle, c)                    \
    S(TreeNode8) F(TreeNode8, low) F(TreeNode8, high) F(TreeNode8, link)                               \
    S(TreeBlock8) F(TreeBlock8, corner) F(TreeBlock8, number)                                          \
    S(SceneLamp) F(SceneLamp, centre_radius) F(SceneLamp, axis_extent) F(SceneLamp, radiance_kept)     \
    F(SceneLamp, middle_sent) F(SceneLamp, chance) F(SceneLamp, cap_density)                           \
    F(SceneLamp, near_squared) F(SceneLamp, alias) F(SceneLamp, face) F(SceneLamp, place)              \
    F(SceneLamp, padding)                                                                              \
    S(EngineLaunch) F(EngineLaunch, camera) F(EngineLaunch, width) F(EngineLaunch, inverse_width)      \
    F(EngineLaunch, first_pixel) F(EngineLaunch, pixels) F(EngineLaunch, inverse_pixels)               \
    F(EngineLaunch, first_run) F(EngineLaunch, units) F(EngineLaunch, path_length)                     \
    F(EngineLaunch, seed) F(EngineLaunch, opaque_spheres) F(EngineLaunch, two_sided_spheres)           \
    F(EngineLaunch, units_per_lane) F(EngineLaunch, first_unit) F(EngineLaunch, slice)                 \
    F(EngineLaunch, strata_columns) F(EngineLaunch, stratum_width) F(EngineLaunch, stratum_height)     \
    F(EngineLaunch, radiance_scale) F(EngineLaunch, squares_scale) F(EngineLaunch, lamps)              \
    F(EngineLaunch, height) F(EngineLaunch, light_slice) F(EngineLaunch, padding) F(EngineLaunch, picture) F(EngineLaunch, lamp)    \
    S(Tally) F(Tally, radiance) F(Tally, squares) F(Tally, samples) F(Tally, segments)                 \
    F(Tally, full_length_paths) F(Tally, shadow_rays)                                                  \
    S(FilmPixel) F(FilmPixel, radiance) F(FilmPixel, squares) F(FilmPixel, samples)                    \
    F(FilmPixel, segments) F(FilmPixel, full_length_paths) F(FilmPixel, shadow_rays)                   \
    S(Splat) F(Splat, radiance) F(Splat, light_segments) F(Splat, shadow_rays) F(Splat, broken) F(Splat, padding) \
    S(GradientPixel) F(GradientPixel, radiance) F(GradientPixel, across) F(GradientPixel, down)        \
    F(GradientPixel, squares)                                                                          \
    S(ReconstructLaunch) F(ReconstructLaunch, width) F(ReconstructLaunch, height)                      \
    F(ReconstructLaunch, groups) F(ReconstructLaunch, problems) F(ReconstructLaunch, samples)          \
    F(ReconstructLaunch, radiance_scale) F(ReconstructLaunch, squares_scale)                           \
    S(ThesisMaterial) F(ThesisMaterial, colour) F(ThesisMaterial, radiance) F(ThesisMaterial, type)   \
    F(ThesisMaterial, ior) F(ThesisMaterial, scatters) F(ThesisMaterial, padding)                     \
    S(ThesisSphere) F(ThesisSphere, centre_radius) F(ThesisSphere, material)                          \
    S(ThesisLaunch) F(ThesisLaunch, camera) F(ThesisLaunch, width) F(ThesisLaunch, first_pixel)       \
    F(ThesisLaunch, pixels) F(ThesisLaunch, samples) F(ThesisLaunch, spp) F(ThesisLaunch, path_length) \
    F(ThesisLaunch, sphere_count) F(ThesisLaunch, padding)

#endif
