#include "core/integrator/placement.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/integrator/device_scene.h"
#include "core/integrator/engine_options.h"

namespace ptb {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Scene shipped(const std::string& name) {
    return load_scene(std::string(PTB_SOURCE_DIR) + "/configs/scenes/" + name + ".json");
}

Material of(MaterialType type) {
    Material material;
    material.type = type;
    material.scatters = type != MaterialType::emitter;
    return material;
}

/// A matte and a glass ball of radius 1 before a sky.
Scene two_balls() {
    Scene scene;
    scene.camera = {{0, 0, -5}, {0, 0, 0}, {0, 1, 0}, 40};
    scene.materials = {of(MaterialType::emitter), of(MaterialType::matte), of(MaterialType::dielectric)};
    scene.spheres = {{{0, 0, 0}, 100, 0}, {{-2, 0, 0}, 1, 1}, {{2, 0, 0}, 1, 2}};
    return scene;
}

Scene in_other_units(const Scene& scene, double scale) {
    Scene result = scene;
    result.camera.position = result.camera.position * scale;
    for (Sphere& sphere : result.spheres)
        sphere = {sphere.centre * scale, sphere.radius * scale, sphere.material};
    return result;
}

std::string gpu_options(const Scene& scene, int path_length) {
    ocl::Device device;
    device.info.type = "GPU";
    RenderJob job;
    job.path_length = path_length;
    return integrator("pt").options(device, scene, job);
}

TEST(Placement, leaves_shipped_scenes_where_they_are) {
    for (const std::string name : {"thesis", "free_light", "furnace"}) {
        const Placement placement = place(shipped(name));
        EXPECT_EQ(placement.origin, (Vec3{0, 0, 0})) << name;
        EXPECT_THAT(placement.forms, Each(Form::plain)) << name;
    }
}

TEST(Placement, finds_a_scene_wherever_it_is) {
    for (const Vec3 by : {Vec3{1e6, 0, 0}, Vec3{0, -1e6, 0}, Vec3{1e4, 1e6, -1e5}}) {
        const Placement placement = place(spheres_seen_from(two_balls(), by));
        EXPECT_THAT(placement.forms, Each(Form::plain));
        EXPECT_LT(length(placement.origin + by), 10) << "the middle of the balls, or the camera";
    }
}

TEST(Placement, does_not_depend_on_the_unit_of_length) {
    const Placement one = place(two_balls());
    for (const double scale : {1e-17, 1e-4, 1e4, 1e15}) {
        const Placement other = place(in_other_units(two_balls(), scale));
        EXPECT_EQ(other.forms, one.forms) << scale;
        EXPECT_NEAR(other.plain_error, one.plain_error, 1e-6 * one.plain_error) << scale;
    }
}

TEST(Placement, takes_balls_that_no_origin_serves_for_distant) {
    Scene scene = two_balls();
    scene.spheres[0].radius = 1e6;
    scene.spheres[2].centre = {0, 0, 20'000};
    EXPECT_THAT(place(scene).forms, testing::Contains(Form::distant));
    EXPECT_NE(place(scene).forms[0], Form::distant) << "the sky";
}

TEST(Placement, takes_a_wall_for_vast_whose_radius_drowns_the_balls_beside_it) {
    Scene scene = two_balls();
    scene.spheres.push_back({{0, -1001, 0}, 1e3, 1});
    EXPECT_EQ(place(scene).forms[3], Form::plain);
    scene.spheres[3] = {{0, -1e6 - 1, 0}, 1e6, 1};
    EXPECT_THAT(place(scene).forms, ElementsAre(Form::plain, Form::plain, Form::plain, Form::vast));
}

TEST(Placement, of_a_scattering_sky_far_away_leaves_a_wall_vast) {
    Scene scene = two_balls();
    scene.spheres[0] = {{0, 0, 0}, 1e7, 1};
    scene.spheres.push_back({{0, -1e6 - 1, 0}, 1e6, 1});
    EXPECT_EQ(place(scene).forms[3], Form::vast);
}

TEST(Placement, tells_a_ball_that_single_precision_loses) {
    Scene scene = two_balls();
    EXPECT_EQ(place(scene).lost, std::nullopt);
    EXPECT_EQ(integrator("pt").refusal({}, scene, {}), "");
    scene.name = "dust";
    scene.spheres[2] = {{0, 1e5, 0}, 1e-3, 1};
    scene.spheres.push_back({{0, -1e5, 0}, 1e-3, 1});
    EXPECT_NE(place(scene).lost, std::nullopt);
    EXPECT_THAT(integrator("pt").refusal({}, scene, {}),
                testing::MatchesRegex("scene dust: /spheres/[23]: pt's single precision loses a radius of "
                                      "0.001 at a distance of [12]00000"));
}

TEST(Placement, of_a_camera_over_a_plain_is_at_the_camera) {
    Scene scene = two_balls();
    scene.spheres = {{{3, 0, 0}, 1e7, 1}};
    scene.camera.position = {3, 1e7 + 2, 0};
    EXPECT_EQ(place(scene).origin, scene.camera.position);
}

TEST(DeviceScene, has_careful_spheres_in_the_middle_and_distant_ones_in_the_middle_of_these) {
    Scene scene = two_balls();
    scene.spheres[0].radius = 1e7;  // the camera is in it
    scene.spheres.push_back({{0, -1e6 - 1, 0}, 1e6, 1});
    for (const int material : {1, 2}) scene.spheres.push_back({{0, 3, 20'000.0 + 4 * material}, 1, material});
    const DeviceScene placed = make_device_scene(scene);
    const Placement placement = place(scene);
    const auto count = [&](Form form) {
        return static_cast<std::uint32_t>(std::count(placement.forms.begin(), placement.forms.end(), form));
    };
    EXPECT_EQ(placed.distant.end - placed.distant.begin, count(Form::distant));
    EXPECT_EQ(placed.careful.end - placed.careful.begin, count(Form::distant) + count(Form::vast));
    EXPECT_LT(placed.distant.begin, placed.opaque);
    EXPECT_GT(placed.distant.end, placed.opaque);
    for (std::uint32_t i = placed.distant.begin; i < placed.distant.end; ++i) {
        EXPECT_EQ(placed.spheres[i].centre_k.w, 1.0f) << "radius^2";
        for (const std::uint32_t zeros : placed.zeros) EXPECT_EQ(zeros >> i & 1u, 0u) << "is not asked";
    }
}

TEST(EngineOptions, let_paths_carry_gaps_only_where_and_while_their_error_is_bearable) {
    EXPECT_THAT(gpu_options(shipped("thesis"), 128), HasSubstr("-DSCENE_CARRIED"));
    EXPECT_THAT(gpu_options(shipped("thesis"), 1'000'000), Not(HasSubstr("-DSCENE_CARRIED")));
    EXPECT_THAT(gpu_options(spheres_seen_from(two_balls(), {1e6, 0, 0}), 128), HasSubstr("-DSCENE_CARRIED"));
    Scene scene = two_balls();
    scene.spheres.push_back({{0, -1e6 - 1, 0}, 1e6, 1});
    EXPECT_THAT(gpu_options(scene, 2), Not(HasSubstr("-DSCENE_CARRIED")));
    EXPECT_THAT(gpu_options(scene, 2), HasSubstr("-DSCENE_CAREFUL_BEGIN=1u -DSCENE_CAREFUL_END=2u"));
}

TEST(EngineOptions, leave_room_for_a_third_group_where_lanes_wait_for_each_other_on_nvidias_gpus) {
    ocl::Device device;
    device.info.type = "GPU";
    const auto options = [&](const std::string& kernel, const std::string& scene) {
        return integrator(kernel).options(device, shipped(scene), {});
    };
    const std::string limit = "-cl-nv-maxrregcount=80";
    EXPECT_THAT(options("pt_nee", "cornell"), AllOf(HasSubstr("-DSCENE_PAUSES"), Not(HasSubstr(limit))));
    device.info.platform = "NVIDIA CUDA";
    EXPECT_THAT(options("pt_nee", "cornell"), HasSubstr(limit));
    EXPECT_THAT(options("whitted", "cornell"), Not(HasSubstr(limit)));
    EXPECT_THAT(options("pt_nee", "thesis"), Not(HasSubstr(limit)));
}

}  // namespace
}  // namespace ptb
