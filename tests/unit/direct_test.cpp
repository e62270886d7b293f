#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/oracle/oracle.h"
#include "core/scene/scene.h"
#include "tests/support/oracle_support.h"

namespace ptb {
namespace {

/// Sine squared of the half angle that a ball of `radius` takes up from `distance`.
double sin_squared(double radius, double distance) { return std::pow(radius / distance, 2); }

TEST(TraceDirect, furnace_is_its_light_and_one_bounce_of_it) {
    Scene scene;
    scene.camera = {{10, 20, -30}, {0, 0, 0}, {0, 1, 0}, 60};
    add(scene, {0, 0, 0}, 100, glowing_wall({1, 1, 1}, {0.5, 0.7, 0.9}));
    for (const int path_length : {1, 2, 128}) {
        const OracleResult result = trace_direct(scene, job(4, 3, path_length));
        expect_every_pixel(result.mean, path_length == 1 ? Vec3{1, 1, 1} : Vec3{1.5, 1.7, 1.9});
        EXPECT_EQ(result.segments, 48U) << "the segment that looks for light is not counted";
        EXPECT_EQ(result.full_length_paths, path_length == 1 ? 48U : 0U);
    }
}

TEST(TraceDirect, of_two_segments_is_the_path_tracer) {
    // One sample a pixel draws the same random numbers in both.
    for (const std::string name : {"thesis", "free_light", "lamps", "furnace"}) {
        const Scene scene = load_scene(std::string(PTB_SOURCE_DIR) + "/configs/scenes/" + name + ".json");
        EXPECT_EQ(trace_direct(scene, job(64, 1, 2)).mean, trace_pt(scene, job(64, 1, 2)).mean) << name;
    }
}

TEST(TraceDirect, a_lamp_at_a_slant_follows_lambert) {
    Scene scene = floor_view();
    add(scene, {-30, 30, 0}, 10, lamp({1, 1, 1}));
    const int spp = 20000;
    const double expected = 0.5 * sin_squared(10, std::hypot(30, 30)) * std::sqrt(0.5);
    expect_mean(trace_direct(scene, job(4, spp, 128)), spp, expected);
}

TEST(TraceDirect, a_ball_before_a_lamp_leaves_a_ring_of_it) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 5, lamp({1, 1, 1}));
    add(scene, {0, 5, 0}, 1, matte(1));
    const int spp = 20000;
    expect_mean(trace_direct(scene, job(4, spp, 128)), spp, 0.5 * (sin_squared(5, 20) - sin_squared(1, 5)));
    scene.spheres.back().radius = 1.3;
    expect_every_pixel(trace_direct(scene, job(4, 1000, 128)).mean, {0, 0, 0});
}

TEST(TraceDirect, no_light_comes_by_matte_or_mirror) {
    // A lamp behind a wall, and a ball that could bring its light to the floor.
    for (const Material& bringer : {matte(1), mirror({1, 1, 1})}) {
        Scene scene = floor_view();
        add(scene, {0, 40, 0}, 4, lamp({100, 100, 100}));
        add(scene, {0, 20, 0}, 6, matte(0));
        add(scene, {-30, 25, 0}, 12, bringer);
        const int spp = 4000;
        expect_every_pixel(trace_direct(scene, job(4, spp, 128)).mean, {0, 0, 0});
        EXPECT_GT(estimate(trace_pt(scene, job(4, spp, 128)), spp).mean, 0) << "a ball that brings nothing";
    }
}

TEST(TraceDirect, a_lamp_in_glass_lights_no_floor_but_is_seen) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 2, lamp({1, 1, 1}));
    add(scene, {0, 20, 0}, 5, glass(1.5));
    expect_every_pixel(trace_direct(scene, job(4, 1000, 128)).mean, {0, 0, 0});
    scene.camera.look_at = {0, 20, 0};
    const int spp = 4000;
    expect_mean(trace_direct(scene, job(4, spp, 2)), spp, 0.96);
}

TEST(TraceDirect, a_mirror_shows_a_lit_floor_in_its_tint) {
    // From the camera to a mirror, to a wall behind the camera, to the lamp: three segments, of which two
    // count.
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, mirror({0.5, 0.5, 0.5}));
    add(scene, {0, 0, -1e6 - 20}, 1e6, matte(0.5));
    add(scene, {30, 0, 10}, 10, lamp({1, 1, 1}));
    const int spp = 20000;
    const double expected = 0.5 * 0.5 * sin_squared(10, std::hypot(30, 30)) * std::sqrt(0.5);
    const OracleResult three = trace_direct(scene, job(4, spp, 3)), two = trace_direct(scene, job(4, 9, 2));
    expect_mean(three, spp, expected);
    EXPECT_EQ(three.segments, 2 * three.samples);
    EXPECT_EQ(three.full_length_paths, 0U);
    expect_every_pixel(two.mean, {0, 0, 0});
    EXPECT_EQ(two.full_length_paths, two.samples);
}

TEST(TraceDirect, what_glows_is_lit_as_well_and_ends_the_path) {
    Scene scene = floor_view();
    scene.materials[0] = glowing_wall({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5});
    add(scene, {0, 20, 0}, 10, lamp({1, 1, 1}));
    const int spp = 20000;
    expect_mean(trace_direct(scene, job(4, spp, 128)), spp, 0.25 + 0.5 * sin_squared(10, 20));
}

}  // namespace
}  // namespace ptb
