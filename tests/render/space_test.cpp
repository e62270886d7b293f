// A picture depends neither on where the scene's origin is nor on its unit of length.
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>

#include "tests/support/devices.h"
#include "tests/support/image_check.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

constexpr int edge = 32, path_length = 8;

Reference truth_of(const Scene& scene) {
    OracleJob job;
    job.size = {edge, edge};
    job.spp = 512;
    job.path_length = path_length;
    job.seed = 99;
    job.threads = 2;
    return reference_of(trace_pt(scene, job), scene, "pt", job);
}

/// One way of building the kernel.
struct Build {
    int lanes;
    std::string options;
};

void expect_truth(const Scene& scene, const Reference& truth, const std::string& name, const Build& build) {
    const ocl::Device device = all_devices().at(0);
    RenderJob job;
    job.size = truth.size;
    job.spp = 256;
    job.path_length = path_length;
    job.lanes = build.lanes;
    const Film film = finish(*make_render(device, "pt", scene, job, build.options));
    EXPECT_TRUE(agrees(fmt::format("{}_lanes{}{}", name, build.lanes, build.options), film, job, truth));
}

void expect_truth(const Scene& scene, const Reference& truth, const std::string& name) {
    for (const int lanes : {1, 8, 16, 32}) expect_truth(scene, truth, name, {lanes, ""});
}

TEST(Space, a_moved_and_scaled_scene_keeps_its_picture) {
    std::mt19937 random(5);
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Scene scene = random_balls(seed, seed == 2);
        const Reference truth = truth_of(scene);
        for (const double scale : {1.0, std::pow(10, 4 * uniform())}) {
            const Vec3 by = Vec3{uniform(), uniform(), uniform()} * std::pow(10, 4.5 + 1.5 * uniform());
            SCOPED_TRACE(fmt::format("scale {}, moved by {}, {}, {}", scale, by.x, by.y, by.z));
            const std::string name = fmt::format("random_balls{}", seed);
            expect_truth(moved(scene, scale, by), truth, name);
            expect_truth(moved(scene, scale, by), truth, name, {1, " -DSCENE_CARRIED"});  // as on GPUs
        }
    }
}

TEST(Space, the_smallest_and_largest_units_of_length_keep_the_picture) {
    const Scene scene = random_balls(4, false);
    const Reference truth = truth_of(scene);
    expect_truth(moved(scene, 1e-17, {0, 0, 0}), truth, "smallest_unit");
    expect_truth(moved(scene, 1e16, {0, 0, 0}), truth, "largest_unit");
}

TEST(Space, small_balls_far_apart_that_no_origin_serves) {
    const Scene scene = balls_far_apart(10'000);
    expect_truth(scene, truth_of(scene), "far_apart");
}

class Wall : public testing::TestWithParam<std::string> {};

TEST_P(Wall, is_met_where_it_is_however_large) {
    const Scene scene = balls_at_a_wall(1e8, GetParam());
    expect_truth(scene, truth_of(scene), GetParam());
}

INSTANTIATE_TEST_SUITE_P(kinds, Wall, testing::Values("matte", "water", "room"),
                         [](const auto& kind) { return kind.param; });

/// More spheres than a kernel argument holds: small ones of matte, glass and mirror in a row.
Scene crowded(Scene scene, const Vec3& first) {
    for (int i = 0; i < 20; ++i) scene.spheres.push_back({first + Vec3{0.4 * i - 4, 0, 0}, 0.15, 1 + i % 3});
    return scene;
}

TEST(Space, has_room_for_many_spheres) {
    const Scene apart = crowded(balls_far_apart(10'000), {0, 2.5, 10'000});
    expect_truth(apart, truth_of(apart), "many_apart");
    const Scene water = crowded(balls_at_a_wall(1e8, "water"), {0, 1, -3});
    expect_truth(water, truth_of(water), "many_in_water");
}

}  // namespace
}  // namespace ptb
