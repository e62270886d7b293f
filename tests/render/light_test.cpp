// Light that formulas know: of lamps over a matte floor, met and asked for.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/support/devices.h"
#include "tests/support/oracle_support.h"
#include "tests/support/render_once.h"

namespace ptb {
namespace {

constexpr double albedo = 0.5, radiance = 10;

Estimate estimate(const Film& film, const RenderJob& job) {
    OracleResult result;
    result.mean = film.mean;
    result.variance = *film.variance;
    return estimate(result, job.spp);
}

void expect_sent_by_floor(const Scene& scene, const std::string& kernel, double expected,
                          const Variant& variant = {}) {
    on_every_device([&](const ocl::Device& device) {
        for (const int lanes : {1, default_lanes(integrator(kernel), device.info)}) {
            SCOPED_TRACE(fmt::format("{}, lanes {}", kernel, lanes));
            RenderJob job;
            job.size = {64, 64};
            job.spp = 64;
            job.path_length = 2;
            job.lanes = lanes;
            job.variant = variant;
            const Estimate found = estimate(render_film(device, kernel, scene, job), job);
            EXPECT_LT(found.standard_error, 0.002 * expected) << "more samples, or a fault is missed";
            EXPECT_NEAR(found.mean, expected, 4 * found.standard_error + 1e-4 * expected);
        }
    });
}

Material light() { return lamp({radiance, radiance, radiance}); }

/// Of a ball that is seen whole, at the middle of the floor.
double sent_under_ball(const Vec3& centre, double radius) {
    const double distance = length(centre);
    return albedo * radiance * (radius * radius) / (distance * distance) * centre.y / distance;
}

/// A ball of radius 5 sunk into a ceiling at this height, but for a cap whose rim has radius 3.
Scene sunk_over_floor(double ceiling) {
    Scene scene = floor_view();
    scene.camera.position = {5, ceiling / 3, 0};
    add(scene, {0, ceiling + 4, 0}, 5, light());
    add(scene, {0, ceiling + 1e6, 0}, 1e6, matte(0));
    return scene;
}

/// Of that: as of a disc, since the rim hides where the ball would be touched.
double sent_under_cap(double ceiling) { return albedo * radiance * 9 / (9 + ceiling * ceiling); }

Variant roulette() {
    Variant variant;
    variant.roulette = Roulette::albedo;
    return variant;
}

class Light : public testing::TestWithParam<std::string> {};

TEST_P(Light, a_large_ball_lights_the_floor_by_its_solid_angle) {
    Scene scene = floor_view();
    add(scene, {-3, 4, 0}, 3, light());
    expect_sent_by_floor(scene, GetParam(), sent_under_ball({-3, 4, 0}, 3));
}

TEST_P(Light, two_balls_light_it_by_their_sum) {
    Scene scene = floor_view();
    add(scene, {-3, 4, 0}, 3, light());
    add(scene, {-1, 5, 6}, 2, light());
    expect_sent_by_floor(scene, GetParam(), sent_under_ball({-3, 4, 0}, 3) + sent_under_ball({-1, 5, 6}, 2));
}

TEST_P(Light, a_cap_lights_it_as_its_rim_does) {
    expect_sent_by_floor(sunk_over_floor(8), GetParam(), sent_under_cap(8));
}

TEST_P(Light, a_near_cap_lights_it_as_its_rim_does) {
    expect_sent_by_floor(sunk_over_floor(3), GetParam(), sent_under_cap(3));
}

TEST_P(Light, roulette_changes_none_of_it) {
    Scene scene = floor_view();
    add(scene, {-3, 4, 0}, 3, light());
    expect_sent_by_floor(scene, GetParam(), sent_under_ball({-3, 4, 0}, 3), roulette());
    expect_sent_by_floor(sunk_over_floor(8), GetParam(), sent_under_cap(8), roulette());
}

INSTANTIATE_TEST_SUITE_P(kernels, Light, testing::Values("direct", "pt_nee"),
                         [](const auto& kernel) { return kernel.param; });

}  // namespace
}  // namespace ptb
