#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/oracle/oracle.h"
#include "core/scene/scene.h"
#include "tests/support/oracle_support.h"

namespace ptb {
namespace {

/// What a floor of albedo 1/2 sends back of a point of radiant `intensity` at a `distance`, straight above.
double floor_under(double intensity, double distance) {
    return 0.5 / std::numbers::pi * intensity / (distance * distance);
}

/// Every pixel of a scene whose samples are all the same, up to the bend of its flat balls.
void expect_whitted(const Scene& scene, int path_length, double value) {
    const OracleResult result = trace_whitted(scene, job(2, 4, path_length));
    for (const float channel : result.mean.rgb) EXPECT_NEAR(channel, value, 2e-5 * value);
}

TEST(TraceWhitted, light_falls_with_the_square_of_the_distance) {
    for (const double distance : {10.0, 20.0, 40.0}) {
        Scene scene = floor_view();
        add(scene, {0, distance, 0}, 3, lamp({2, 2, 2}));
        expect_whitted(scene, 2, floor_under(2 * std::numbers::pi * 9, distance));
    }
}

TEST(TraceWhitted, light_at_a_slant_falls_with_the_cosine) {
    Scene scene = floor_view();
    add(scene, {-30, 40, 0}, 3, lamp({2, 2, 2}));
    expect_whitted(scene, 2, floor_under(2 * std::numbers::pi * 9, 50) * 0.8);
}

TEST(TraceWhitted, lamps_add_up) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 3, lamp({2, 2, 2}));
    add(scene, {-30, 40, 0}, 3, lamp({2, 2, 2}));
    const double intensity = 2 * std::numbers::pi * 9;
    expect_whitted(scene, 2, floor_under(intensity, 20) + floor_under(intensity, 50) * 0.8);
}

TEST(TraceWhitted, a_far_small_lamp_lights_as_the_real_one_does) {
    Scene scene = floor_view();
    add(scene, {-60, 80, 0}, 10, lamp({1, 1, 1}));
    const int spp = 40000;
    expect_mean(trace_direct(scene, job(4, spp, 2)), spp,
                estimate(trace_whitted(scene, job(4, 1, 2)), 1).mean);
}

TEST(TraceWhitted, light_is_the_next_segment_and_the_path_ends_there) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 3, lamp({1, 1, 1}));
    expect_whitted(scene, 128, floor_under(std::numbers::pi * 9, 20));
    expect_whitted(scene, 1, 0);
    EXPECT_EQ(trace_whitted(scene, job(2, 4, 128)).segments, 16U);
}

TEST(TraceWhitted, a_mirror_shows_a_lit_wall_in_its_tint) {
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, mirror({0.5, 0.5, 0.5}));
    add(scene, {0, 0, -1e6 - 20}, 1e6, matte(0.5));
    add(scene, {30, 0, 20}, 3, lamp({2, 2, 2}));
    expect_whitted(scene, 3, 0.5 * floor_under(2 * std::numbers::pi * 9, 50) * 0.8);
    expect_whitted(scene, 2, 0);
    EXPECT_EQ(trace_whitted(scene, job(2, 4, 3)).segments, 32U);
}

TEST(TraceWhitted, shadows_are_hard_and_of_glass_too) {
    for (const Material& material : {matte(1), mirror({1, 1, 1}), glass(1.5), lamp({0, 0, 0})}) {
        Scene scene = floor_view();
        add(scene, {0, 20, 0}, 10, lamp({1, 1, 1}));
        add(scene, {0, 5, 0}, 0.1, material);
        expect_whitted(scene, 128, 0);
        scene.spheres.back().centre.z = 0.101;  // before the lamp, but beside its middle
        expect_whitted(scene, 128, floor_under(std::numbers::pi * 100, 20));
    }
}

TEST(TraceWhitted, what_lies_behind_a_lamp_does_not_block_it) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 3, lamp({1, 1, 1}));
    add(scene, {0, 30, 0}, 5, matte(1));
    expect_whitted(scene, 2, floor_under(std::numbers::pi * 9, 20));
}

TEST(TraceWhitted, a_sunk_lamp_lights_from_the_middle_of_its_cap) {
    // A ceiling at a height of 20 leaves half of the lower half of a lamp of radius 4: a cap of height 2.
    for (const bool is_room : {false, true}) {
        Scene scene = floor_view();
        add(scene, {0, is_room ? 20 - 1e6 : 20 + 1e6, 0}, 1e6, matte(0));
        add(scene, {0, 22, 0}, 4, lamp({3, 3, 3}));
        expect_whitted(scene, 2, floor_under(3 * std::numbers::pi * 4 * 2, 18));
    }
}

TEST(TraceWhitted, of_two_spheres_the_one_that_hides_more_makes_the_cap) {
    Scene scene = floor_view();
    add(scene, {0, 21 + 1e6, 0}, 1e6, matte(0));
    add(scene, {0, 22, 0}, 4, lamp({3, 3, 3}));
    add(scene, {0, 20 + 1e6, 0}, 1e6, matte(0));
    expect_whitted(scene, 2, floor_under(3 * std::numbers::pi * 4 * 2, 18));
}

TEST(TraceWhitted, a_sunk_lamp_lights_nothing_behind_its_cap) {
    // A ball under the ceiling, seen from the lamp's side: above the plane through the cap's middle, below
    // it.
    Scene scene;
    add(scene, {0, 20 + 1e6, 0}, 1e6, matte(0));
    add(scene, {0, 22, 0}, 4, lamp({1, 1, 1}));
    add(scene, {30, 0, 0}, 0.5, matte(1));
    for (const double height : {18.6, 17.4}) {
        scene.spheres.back().centre.y = height;
        scene.camera = {{20, height, 0}, {30, height, 0}, {0, 1, 0}, 1e-4};
        const double light = estimate(trace_whitted(scene, job(2, 4, 2)), 4).mean;
        EXPECT_EQ(light > 0, height < 18) << "at a height of " << height;
    }
}

TEST(TraceWhitted, a_lamp_that_glass_cuts_hangs_free) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 3, lamp({1, 1, 1}));
    add(scene, {0, 24, 0}, 3, glass(1.5));
    expect_whitted(scene, 2, floor_under(std::numbers::pi * 9, 20));
}

TEST(TraceWhitted, hidden_lamps_light_nothing) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 1, lamp({1, 1, 1}));
    add(scene, {0, 20, 0}, 2, matte(1));
    expect_whitted(scene, 2, 0);
}

TEST(TraceWhitted, a_lamp_in_glass_lights_what_is_in_there_alone) {
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 1, lamp({1, 1, 1}));
    add(scene, {0, 20, 0}, 5, glass(1.5));
    expect_whitted(scene, 128, 0);
    scene.spheres.back().radius = 1000;  // the floor, too, and the camera
    expect_whitted(scene, 128, floor_under(std::numbers::pi, 20));
}

TEST(TraceWhitted, in_a_lamp_its_light_is_seen_and_nothing_is_lit) {
    Scene furnace;
    furnace.camera = {{10, 20, -30}, {0, 0, 0}, {0, 1, 0}, 60};
    add(furnace, {0, 0, 0}, 100, glowing_wall({1, 1, 1}, {0.5, 0.7, 0.9}));
    expect_every_pixel(trace_whitted(furnace, job(4, 3, 128)).mean, {1, 1, 1});
    Scene scene = narrow_view();
    add(scene, {0, 0, 0}, 100, lamp({1, 1, 1}));
    add(scene, {0, 0, 10}, 1, matte(1));
    expect_every_pixel(trace_whitted(scene, job(4, 3, 128)).mean, {0, 0, 0});
}

TEST(TraceWhitted, what_glows_does_not_light_itself) {
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, glowing_wall({1, 2, 3}, {1, 1, 1}));
    expect_every_pixel(trace_whitted(scene, job(4, 3, 128)).mean, {1, 2, 3});
    // Nor when sunk and seen right in the middle of its cap, where its point is.
    add(scene, {0, 0, 1e6 + 9.5}, 1e6, matte(0));
    OracleJob middle = job(1, 1, 128);
    middle.pixel_centres = true;
    expect_every_pixel(trace_whitted(scene, middle).mean, {1, 2, 3});
}

TEST(Tracers, results_do_not_depend_on_threads) {
    const Scene scene = load_scene(std::string(PTB_SOURCE_DIR) + "/configs/scenes/lamps.json");
    for (const auto& [kernel, trace] : tracers()) {
        OracleJob one = job(9, 8, 128), three = one;
        three.threads = 3;
        const OracleResult a = trace(scene, one), b = trace(scene, three);
        EXPECT_EQ(a.mean, b.mean) << kernel;
        EXPECT_EQ(a.variance, b.variance) << kernel;
        EXPECT_EQ(a.segments, b.segments) << kernel;
    }
}

}  // namespace
}  // namespace ptb
