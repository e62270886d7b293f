#include "core/oracle/oracle.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/oracle/random.h"
#include "core/scene/scene.h"
#include "tests/support/oracle_support.h"

namespace ptb {
namespace {

double geometric(double albedo, int terms) { return (1 - std::pow(albedo, terms)) / (1 - albedo); }

TEST(TracePt, furnace_has_its_closed_form_at_every_length) {
    // Breaks when a bounce is lost, taken twice or weighted wrongly, or when a ray slips through a closed
    // wall.
    Scene scene;
    scene.camera = {{10, 20, -30}, {0, 0, 0}, {0, 1, 0}, 60};
    add(scene, {0, 0, 0}, 100, glowing_wall({1, 1, 1}, {0.5, 0.7, 0.9}));
    for (const int path_length : {1, 2, 5, 128}) {
        const OracleResult result = trace_pt(scene, job(4, 3, path_length));
        expect_every_pixel(result.mean, {geometric(0.5, path_length), geometric(0.7, path_length),
                                         geometric(0.9, path_length)});
        expect_every_pixel(result.variance, {0, 0, 0});
        EXPECT_EQ(result.samples, 48U);
        EXPECT_EQ(result.segments, 48U * static_cast<unsigned>(path_length));
        EXPECT_EQ(result.full_length_paths, 48U);
        EXPECT_EQ(result.segments_variance, 0);
    }
}

TEST(TracePt, huge_closed_room_loses_no_path) {
    // The trap of the thesis' scene: walls of radius 10 000 that rays meet at grazing angles, thousands of
    // units away.
    Scene scene;
    scene.camera = {{9999, 0, 0}, {9999, 1, 5}, {1, 0, 0}, 90};
    add(scene, {0, 0, 0}, 10000, glowing_wall({1, 1, 1}, {0.5, 0.5, 0.5}));
    const OracleResult result = trace_pt(scene, job(8, 16, 128));
    expect_every_pixel(result.mean, {geometric(0.5, 128), geometric(0.5, 128), geometric(0.5, 128)});
    EXPECT_EQ(result.segments, 8U * 8 * 16 * 128);
}

TEST(TracePt, a_path_leaves_the_outside_of_a_ball_for_good) {
    // Two segments: to the ball, and away. More would be a ball that is met again from its own surface.
    Scene scene = narrow_view();
    add(scene, {0, 0, 20000}, 10000, matte(0.5));
    const OracleResult result = trace_pt(scene, job(8, 64, 128));
    EXPECT_EQ(result.segments, 2U * 8 * 8 * 64);
    EXPECT_EQ(result.full_length_paths, 0U);
}

TEST(TracePt, result_does_not_depend_on_threads) {
    const Scene scene = load_scene(std::string(PTB_SOURCE_DIR) + "/configs/scenes/thesis.json");
    for (auto* trace : {trace_pt, trace_thesis}) {
        OracleJob one = job(9, 8, 128), three = one, other_seed = one;
        three.threads = 3;
        other_seed.seed = 2;
        const OracleResult a = trace(scene, one), b = trace(scene, three);
        EXPECT_EQ(a.mean, b.mean);
        EXPECT_EQ(a.variance, b.variance);
        EXPECT_EQ(a.segments, b.segments);
        EXPECT_EQ(a.segments_variance, b.segments_variance);
        EXPECT_NE(trace(scene, other_seed).mean, a.mean) << "the seed changes nothing";
    }
}

TEST(TracePt, length_one_sees_the_light_and_nothing_else) {
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, lamp({3, 2, 1}));
    add(scene, {0, 50, 0}, 10, matte(1));
    const OracleResult result = trace_pt(scene, job(2, 4, 1));
    expect_every_pixel(result.mean, {3, 2, 1});
    EXPECT_EQ(result.segments, 16U);
    EXPECT_EQ(result.full_length_paths, 16U);
}

TEST(TracePt, a_light_shines_inwards_too_and_ends_the_path) {
    Scene scene = narrow_view();
    add(scene, {0, 0, 0}, 5, lamp({3, 2, 1}));
    const OracleResult result = trace_pt(scene, job(2, 4, 128));
    expect_every_pixel(result.mean, {3, 2, 1});
    EXPECT_EQ(result.segments, 16U);
}

TEST(TracePt, mirror_shows_what_is_behind_the_camera_in_its_tint) {
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, mirror({0.5, 1, 0.25}));
    add(scene, {0, 0, -10}, 5, lamp({8, 4, 2}));
    expect_every_pixel(trace_pt(scene, job(2, 4, 2)).mean, {4, 4, 0.5});
    expect_every_pixel(trace_pt(scene, job(2, 4, 1)).mean, {0, 0, 0});
}

TEST(TracePt, tints_multiply_along_the_path) {
    // Along z to a mirror at (0, 0, 10), along x to one at (10, 0, 10), along z again to the lamp.
    Scene scene = narrow_view();
    const double s = std::sqrt(0.5);
    add(scene, {-s, 0, 10 + s}, 1, mirror({0.5, 1, 0.25}));
    add(scene, {10 + s, 0, 10 - s}, 1, mirror({0.5, 0.5, 0.5}));
    add(scene, {10, 0, 30}, 5, lamp({8, 4, 2}));
    for (auto* trace : {trace_pt, trace_thesis})
        expect_every_pixel(trace(scene, job(2, 4, 3)).mean, {2, 2, 0.25});
}

TEST(TracePt, glass_reflects_its_share_at_normal_incidence) {
    // 4 % goes back to the lamp behind the camera at length 2; see any table of Fresnel's formulas for n
    // = 1.5.
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, glass(1.5));
    add(scene, {0, 0, -10}, 5, lamp({1, 1, 1}));
    const int spp = 4000;
    const Estimate found = estimate(trace_pt(scene, job(4, spp, 2)), spp);
    EXPECT_NEAR(found.mean, 0.04, 4 * found.standard_error);
}

TEST(TracePt, glass_ball_passes_the_rest_through_all_its_bounces) {
    // Along the axis: through both faces (1 - R)^2, plus two, four, ... reflections inside: (1 - R)^2 / (1 -
    // R^2).
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, glass(1.5));
    add(scene, {0, 0, 30}, 5, lamp({1, 1, 1}));
    const int spp = 4000;
    const Estimate found = estimate(trace_pt(scene, job(4, spp, 128)), spp);
    EXPECT_NEAR(found.mean, 0.96 * 0.96 / (1 - 0.04 * 0.04), 4 * found.standard_error);
}

TEST(TracePt, camera_inside_a_glass_ball_looks_out) {
    // Radiance is not scaled by the squared index: what leaves at once is 0.96, and length 2 ends there.
    // forth.
    Scene scene = narrow_view();
    add(scene, {0, 0, 0}, 1, glass(1.5));
    add(scene, {0, 0, 10}, 5, lamp({1, 1, 1}));
    const int spp = 4000;
    const OracleResult result = trace_pt(scene, job(4, spp, 2));
    const Estimate found = estimate(result, spp);
    EXPECT_NEAR(found.mean, 0.96, 4 * found.standard_error);
}

TEST(TracePt, total_reflection_keeps_every_path_inside) {
    // From near the wall, along it: beyond the critical angle (41.8 degrees for 1.5) at every bounce of a
    // ball.
    Scene scene;
    scene.camera = {{0.95, 0, 0}, {0.95, 1, 0}, {0, 0, 1}, 1};
    add(scene, {0, 0, 0}, 1, glass(1.5));
    const OracleResult result = trace_pt(scene, job(4, 4, 128));
    EXPECT_EQ(result.full_length_paths, 64U);
}

TEST(TracePt, index_one_is_invisible) {
    Scene scene;
    scene.camera = {{0, 0, -5}, {0, 0, 0}, {0, 1, 0}, 40};
    add(scene, {0, 0, 0}, 1, glass(1));
    add(scene, {0, 0, 0}, 100, lamp({1, 2, 3}));
    expect_every_pixel(trace_pt(scene, job(8, 4, 5)).mean, {1, 2, 3});
}

TEST(TracePt, clear_balls_do_not_change_a_furnace) {
    // Energy balance of Fresnel, refraction and the set of spheres that a path is inside of, bubbles
    // included.
    Scene scene;
    scene.camera = {{0, 0, -5}, {0, 0, 0}, {0, 1, 0}, 60};
    add(scene, {0, 0, 0}, 2, glass(1.5));
    add(scene, {0.3, 0.2, 0}, 0.5, glass(0.7));
    add(scene, {2.5, 0, 0}, 0.4, mirror({1, 1, 1}));
    add(scene, {0, 0, 0}, 100, lamp({1, 1, 1}));
    expect_every_pixel(trace_pt(scene, job(16, 16, 2000)).mean, {1, 1, 1});
}

TEST(TracePt, matte_floor_under_a_round_lamp_follows_lambert) {
    // A lamp of radiance 1 and half angle t about the normal gives albedo * sin(t)^2; uniform directions
    // instead of cosine-weighted ones would give 1 - cos(t).
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 10, lamp({1, 1, 1}));
    const int spp = 20000;
    const Estimate found = estimate(trace_pt(scene, job(4, spp, 2)), spp);
    EXPECT_NEAR(found.mean, 0.5 * 0.25, 4 * found.standard_error + 1e-5);
}

TEST(TracePt, picture_is_upright_with_right_being_view_cross_up) {
    // Looking along +z with y up, +x is on the left: lamps to the upper left in red, to the lower right in
    // green.
    Scene scene;
    scene.camera = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 90};
    add(scene, {5, 5, 10}, 1, lamp({1, 0, 0}));
    add(scene, {-5, -5, 10}, 1, lamp({0, 1, 0}));
    for (auto* trace : {trace_pt, trace_thesis}) {
        const Image image = trace(scene, job(4, 64, 1)).mean;
        EXPECT_GT(image.rgb[3 * (1 * 4 + 1)], 0) << "upper left";
        EXPECT_GT(image.rgb[3 * (2 * 4 + 2) + 1], 0) << "lower right";
        EXPECT_EQ(image.rgb[3 * (2 * 4 + 1)], 0);
        EXPECT_EQ(image.rgb[3 * (1 * 4 + 2) + 1], 0);
    }
}

TEST(TracePt, field_of_view_is_across_the_width_and_pixels_are_square) {
    // A lamp that fills the left half up to 45 degrees and no more rows than a square pixel's height allows.
    Scene scene;
    scene.camera = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 90};
    add(scene, {0, 0, 100}, 100 * std::sin(std::numbers::pi / 8), lamp({1, 1, 1}));
    OracleJob wide = job(0, 4000, 1);
    wide.size = {40, 10};
    const OracleResult result = trace_pt(scene, wide);
    // The disc has radius tan(22.5 degrees) in a picture of half width 1 and half height 1/4: a strip of the
    // disc.
    const double r = std::tan(std::numbers::pi / 8), h = 0.25;
    const double area = 2 * (h * std::sqrt(r * r - h * h) + r * r * std::asin(h / r));
    const Estimate found = estimate(result, wide.spp);
    EXPECT_NEAR(found.mean, area / (2 * 2 * h), 4 * found.standard_error);
}

TEST(TracePt, variance_is_that_of_one_sample) {
    // A pixel of which a lamp covers the share p has variance p (1 - p).
    Scene scene;
    scene.camera = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 90};
    add(scene, {0, 0, 100}, 100 * std::sin(std::numbers::pi / 8), lamp({1, 1, 1}));
    const int spp = 40000;
    const OracleResult result = trace_pt(scene, job(1, spp, 1));
    const double share = static_cast<double>(result.mean.rgb[0]);
    EXPECT_NEAR(static_cast<double>(result.variance.rgb[0]), share * (1 - share), 1e-4);
}

TEST(TraceThesis, a_path_that_does_not_reach_the_light_is_black) {
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, mirror({0.5, 1, 0.25}));
    add(scene, {0, 0, -10}, 5, lamp({8, 4, 2}));
    expect_every_pixel(trace_thesis(scene, job(2, 4, 2)).mean, {4, 4, 0.5});
    expect_every_pixel(trace_thesis(scene, job(2, 4, 1)).mean, {0, 0, 0});
    Scene glowing = narrow_view();
    add(glowing, {0, 0, 10}, 1, glowing_wall({1, 1, 1}, {0.5, 0.5, 0.5}));
    expect_every_pixel(trace_thesis(glowing, job(2, 4, 128)).mean, {0, 0, 0});  // it leaves
    expect_every_pixel(trace_thesis(glowing, job(2, 4, 1)).mean, {0, 0, 0});    // it is cut
}

TEST(TraceThesis, only_the_nearer_root_is_tested) {
    // From inside, a sphere is not seen at all.
    Scene scene = narrow_view();
    add(scene, {0, 0, 0}, 5, lamp({1, 1, 1}));
    const OracleResult result = trace_thesis(scene, job(2, 4, 128));
    expect_every_pixel(result.mean, {0, 0, 0});
    EXPECT_EQ(result.segments, 16U);
}

TEST(TraceThesis, glass_is_inverted) {
    // At normal incidence 96 % is sent back, where Fresnel would send 4 %.
    Scene scene = narrow_view();
    add(scene, {0, 0, 10}, 1, glass(1.5));
    add(scene, {0, 0, -10}, 5, lamp({1, 1, 1}));
    const int spp = 4000;
    const Estimate found = estimate(trace_thesis(scene, job(4, spp, 2)), spp);
    EXPECT_NEAR(found.mean, 0.96, 4 * found.standard_error);
}

TEST(TraceThesis, matte_directions_are_those_of_the_cube) {
    // A lamp of half angle t about a face's normal is hit by the points of the cube (volume 8) in the cone
    // above and, turned over, the cone below (volume pi tan(t)^2 / 3 each). Lambert's weight would give
    // sin(t)^2 instead.
    Scene scene = floor_view();
    add(scene, {0, 20, 0}, 10, lamp({1, 1, 1}));
    const int spp = 20000;
    const Estimate found = estimate(trace_thesis(scene, job(4, spp, 2)), spp);
    const double tan_squared = 0.25 / (1 - 0.25);
    EXPECT_NEAR(found.mean, 0.5 * std::numbers::pi * tan_squared / 12, 4 * found.standard_error + 1e-5);
}

TEST(ParkMiller, ten_thousandth_number_is_that_of_the_paper) {
    // "Random Number Generators: Good Ones Are Hard to Find": from 1, the 10 000th state is 1043618065.
    ParkMiller random(0);
    double number = 0;
    for (int i = 0; i < 10000; ++i) number = random.uniform();
    EXPECT_EQ(number, 1043618065.0 / 2147483647.0);
}

TEST(SplitMix64, first_numbers_are_those_of_the_published_generator) {
    SplitMix64 random(1234567);
    EXPECT_EQ(random.next(), 6457827717110365317U);
    EXPECT_EQ(random.next(), 3203168211198807973U);
}

}  // namespace
}  // namespace ptb
