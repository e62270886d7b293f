#include "core/integrator/device_scene.h"

#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "core/integrator/device_meshes.h"
#include "core/integrator/unit_cut.h"

using namespace ptb;

namespace {

Material material(MaterialType type) {
    Material result;
    result.type = type;
    result.albedo = result.reflectance = {0.5, 0.25, 0.125};
    result.ior = 1.5;
    result.scatters = true;
    return result;
}

/// A matte sphere before the camera, a glass one around it, and a mirror.
Scene three_spheres() {
    Scene scene;
    scene.camera.position = {0, 0, -4};
    scene.camera.look_at = {0, 0, 0};
    scene.materials = {material(MaterialType::matte), material(MaterialType::dielectric),
                       material(MaterialType::mirror)};
    scene.spheres = {{{0, 3, 0}, 2, 0}, {{1, 0, 0}, 8, 1}, {{-3, 0, 5}, 4, 2}};
    return scene;
}

TEST(DeviceScene, has_boxes_of_triangles_large_enough_for_rays_from_far_away) {
    Scene scene;
    scene.materials = {material(MaterialType::matte)};
    scene.camera.position = {0, 0, 0.5};
    scene.meshes = {{"triangle", 0, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}};
    const auto half_x = [&] { return mesh_tree(scene, {}, TreeLayout::bvh2, {})->nodes2.at(0).half0.x; };
    EXPECT_EQ(half_x(), 0.5f + 6 * 0x1p-23f);
    scene.camera.position = {0, -1000, 0};
    EXPECT_EQ(half_x(), 0.5f + 6 * 0x1p-14f);
    scene.spheres = {{{0, 0, 3000}, 2000, 0}};
    EXPECT_EQ(half_x(), 0.5f + 6 * 0x1p-11f);
}

TEST(DeviceScene, has_both_faces_of_what_a_path_can_be_in_then_the_others) {
    const DeviceScene scene = make_device_scene(three_spheres());
    EXPECT_EQ(scene.opaque, 2u);
    EXPECT_EQ(scene.two_sided, 1u);
    ASSERT_EQ(scene.faces(), 4u);
    EXPECT_EQ(scene.spheres[2].centre_k.x, 1.0f) << "two-sided spheres are the last";
    const SceneSurface& outer = scene.surfaces[0];
    const SceneSurface& inner = scene.surfaces[1];
    EXPECT_FLOAT_EQ(outer.traits.y, 1 / 1.5f / 8) << "outwards eta";
    EXPECT_FLOAT_EQ(inner.traits.y, -1.5f / 8);
    EXPECT_FLOAT_EQ(outer.weight_eta.w, 1 / 2.25f) << "eta^2";
    EXPECT_FLOAT_EQ(inner.weight_eta.w, 2.25f);
    EXPECT_FLOAT_EQ(outer.traits.w, 1 - 1 / 2.25f);
    EXPECT_FLOAT_EQ(inner.traits.w, 1 - 2.25f);
    EXPECT_FLOAT_EQ(outer.traits.z, 1.5f / 8) << "outwards / eta";
    EXPECT_FLOAT_EQ(inner.traits.z, -1 / 1.5f / 8);
    EXPECT_FLOAT_EQ(outer.traits.x, 2.0f / 64) << "2 / radius^2";
    EXPECT_EQ(outer.centre_matte.w, 0.0f);
}

TEST(DeviceScene, tells_matte_from_mirror_and_both_from_what_ends_a_path) {
    const DeviceScene scene = make_device_scene(three_spheres());
    const SceneSurface& matte = scene.surfaces[2];
    EXPECT_FLOAT_EQ(matte.centre_matte.w, 1.0f / 2);
    EXPECT_EQ(matte.traits.x, 0.0f);
    EXPECT_TRUE(std::isnan(matte.weight_eta.w) && std::isnan(matte.traits.w)) << "nothing goes through";
    const SceneSurface& mirror = scene.surfaces[3];
    EXPECT_EQ(mirror.centre_matte.w, 0.0f);
    EXPECT_FLOAT_EQ(mirror.traits.x, 2.0f / 16);
    const SceneSurface& background = scene.surfaces[4];
    EXPECT_LT(background.traits.x, 0.0f);
    EXPECT_TRUE(std::isnan(background.weight_eta.w) && std::isnan(background.traits.w));
}

TEST(DeviceScene, knows_the_zeros_of_centres_and_what_paths_start_with) {
    const DeviceScene scene = make_device_scene(three_spheres());
    EXPECT_EQ(scene.zeros[0], 0b001u);
    EXPECT_EQ(scene.zeros[1], 0b110u);
    EXPECT_EQ(scene.zeros[2], 0b101u);
    EXPECT_EQ(scene.camera_sides.front(), 0x80000001u) << "inside the glass, which is alone";
    const auto start = std::bit_cast<SceneStart>(scene.surfaces.back());
    EXPECT_EQ(start.position_side.z, -4.0f);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(start.position_side.w), scene.camera_sides.front());
    EXPECT_FLOAT_EQ(start.gap[0], 4 - (9 + 16)) << "radius^2 - |camera - centre|^2";
    EXPECT_EQ(start.distance_mask, ~15u);
}

TEST(DeviceScene, counts_faces_where_spheres_are_few) {
    Scene scene = three_spheres();
    while (scene.spheres.size() < SCENE_FEW_MOST - 1) scene.spheres.push_back(scene.spheres[0]);
    EXPECT_TRUE(make_device_scene(scene).is_few()) << "15 faces of 14 spheres";
    scene.spheres.push_back(scene.spheres[0]);
    EXPECT_FALSE(make_device_scene(scene).is_few());
}

TEST(Runs, cover_all_samples_in_rounds_of_ever_shorter_runs) {
    const Runs runs = make_runs(1000, 100, 256);
    EXPECT_EQ(runs.starts.front(), 0u);
    EXPECT_EQ(runs.starts.back(), 1000u);
    ASSERT_EQ(runs.count(), 12u) << "four rounds of three";
    EXPECT_EQ(runs.longest(), runs.length(0));
    for (std::uint32_t run = 0; run < runs.count(); ++run) {
        EXPECT_GT(runs.length(run), 0u);
        EXPECT_EQ(runs.ends_round(run), run % 3 == 2);
    }
    const Runs uncut = make_runs(1002, 100'000, 512);
    ASSERT_EQ(uncut.count(), 2u);
    EXPECT_TRUE(uncut.ends_round(0) && uncut.ends_round(1));
    EXPECT_LT(runs.length(2), runs.length(1));
    EXPECT_LT(runs.length(1), runs.length(0));
}

TEST(Runs, are_single_samples_where_lanes_are_many_and_never_longer_than_a_device_allows) {
    EXPECT_EQ(make_runs(7, 1, 256).count(), 7u);
    EXPECT_EQ(make_runs(1, 1000, 256).count(), 1u);
    EXPECT_EQ(make_runs(1000, 1000, 3).longest(), 3u);
    EXPECT_EQ(make_runs(5, 24, 512).starts, (std::vector<std::uint32_t>{0, 3, 4, 5}));
    EXPECT_EQ(make_runs(5, 25, 512).count(), 1u) << "as short as the last one of a round";
}

/// Pieces of at most so many samples, with what they hold.
std::vector<UnitPiece> pieces(UnitCut& cut, std::uint64_t samples) {
    std::vector<UnitPiece> all;
    while (cut.samples_left() > 0) {
        all.push_back(cut.next(samples));
        cut.step_over(all.back());
    }
    return all;
}

TEST(UnitCut, takes_whole_rounds_where_the_budget_holds_them) {
    UnitCut cut(make_runs(1000, 100, 256), 10, 1000);
    EXPECT_EQ(cut.samples_left(), 10'000u);
    EXPECT_EQ(cut.parts(), 40u) << "four rounds of ten pixels";
    const auto two_at_once = pieces(cut, 5000);
    ASSERT_EQ(two_at_once.size(), 2u);
    EXPECT_EQ(two_at_once[1].first_run, 6u);
    EXPECT_EQ(two_at_once[1].units, 60u) << "ten pixels, two rounds of three runs";
}

TEST(UnitCut, takes_bands_of_pixels_with_all_runs_of_a_round_where_it_does_not) {
    UnitCut cut(make_runs(1000, 100, 256), 10, 1000);
    const auto bands = pieces(cut, 1000);
    ASSERT_EQ(bands.size(), 12u) << "4, 4 and 2 pixels a round";
    EXPECT_EQ(bands[1].first_pixel, 4u);
    EXPECT_EQ(bands[1].units, 12u);
    EXPECT_EQ(bands[3].first_run, 3u);
    cut.restart();
    EXPECT_EQ(pieces(cut, 1).size(), 40u) << "a part is the least";
}

TEST(UnitCut, of_some_parts_ends_with_them) {
    UnitCut cut(make_runs(1000, 100, 256), 10, 1000);
    cut.take({5, 25});
    EXPECT_EQ(cut.samples_left(), 20u * 250);
    const auto some = pieces(cut, 1'000'000);
    ASSERT_EQ(some.size(), 3u) << "the rest of a round, a whole one, and a part of the next";
    EXPECT_EQ(some[0].first_pixel, 5u);
    EXPECT_EQ(some[1].pixels, 10u);
    EXPECT_EQ(some[2].pixels, 5u);
    EXPECT_EQ(some[2].first_run, 6u);
    EXPECT_EQ(cut.left(), (PartRange{25, 25}));
    cut.restart();
    EXPECT_EQ(cut.left(), (PartRange{0, 40}));
}

}  // namespace
