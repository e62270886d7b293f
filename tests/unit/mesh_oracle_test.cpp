// The host's tracers among triangles, by closed forms and by the spheres that triangles come close to.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/oracle/facets.h"
#include "core/oracle/oracle.h"
#include "core/oracle/random.h"
#include "tests/support/oracle_support.h"

namespace ptb {
namespace {

using std::numbers::pi;

double geometric_sum(double albedo, int terms) { return (1 - std::pow(albedo, terms)) / (1 - albedo); }

/// Two triangles in the plane z = `z`, from -1 to 1, whose outside is toward the origin.
std::vector<std::array<Vec3, 3>> square(double z, double half_side = 1) {
    const double h = half_side;
    return {{Vec3{-h, -h, z}, Vec3{-h, h, z}, Vec3{h, h, z}},
            {Vec3{-h, -h, z}, Vec3{h, h, z}, Vec3{h, -h, z}}};
}

TEST(MeshOracle, furnace_of_triangles_has_its_closed_form_at_every_length) {
    // Breaks when a ray slips between triangles, or meets the one that it leaves.
    for (const auto& [shape, detail] : {std::pair("box", 0), std::pair("box", 3), std::pair("sphere", 2)}) {
        SCOPED_TRACE(shape);
        Scene scene;
        scene.camera = {{10, 20, -30}, {0, 0, 0}, {0, 1, 0}, 60};
        add_shape(scene, shape, detail, {100, {10, 20, 30}, {1, 2, 3}},
                  glowing_wall({1, 1, 1}, {0.5, 0.7, 0.9}));
        for (const int path_length : {1, 2, 5, 128}) {
            const OracleResult result = trace_pt(scene, job(4, 3, path_length));
            expect_every_pixel(result.mean, {geometric_sum(0.5, path_length), geometric_sum(0.7, path_length),
                                             geometric_sum(0.9, path_length)});
            EXPECT_EQ(result.segments, 48U * static_cast<unsigned>(path_length));
            EXPECT_EQ(result.full_length_paths, 48U);
        }
    }
}

TEST(MeshOracle, rays_aimed_at_edges_and_vertices_of_a_closed_mesh_meet_it) {
    Scene scene;
    add_shape(scene, "sphere", 3, {1, {3, 4, 5}, {}}, matte(0.5));
    const Facets facets(scene);
    SplitMix64 random(7);
    int lost = 0;
    const auto at_most_one = [&] { return 2 * random.uniform() - 1; };
    for (int i = 0; i < 20'000; ++i) {
        const Facet& facet =
            facets[static_cast<int>(random.next() % static_cast<std::uint64_t>(facets.count()))];
        const double along = i % 2 == 0 ? 0 : random.uniform();
        const Vec3 target = facet.a + (facet.b - facet.a) * along;
        const Vec3 origin = Vec3{at_most_one(), at_most_one(), at_most_one()} * 0.5;
        lost += facets.nearest({origin, normalized(target - origin)}, -1, -1).facet < 0 ? 1 : 0;
    }
    EXPECT_EQ(lost, 0);
}

TEST(MeshOracle, rays_meet_a_finer_and_finer_sphere_where_they_meet_the_sphere) {
    // Cutting a triangle in four takes its distance from the sphere to a quarter.
    SplitMix64 random(3);
    const auto at_most = [&](double most) { return most * (2 * random.uniform() - 1); };
    std::vector<PathRay> rays;
    for (int i = 0; i < 500; ++i)
        rays.push_back({{at_most(0.4), at_most(0.4), -3}, normalized({at_most(0.05), at_most(0.05), 1})});
    std::vector<double> errors;
    for (const int detail : {3, 4, 5}) {
        Scene scene;
        add_shape(scene, "sphere", detail, {}, matte(0.5));
        const Facets facets(scene);
        double error = 0;
        for (const PathRay& ray : rays) {
            const double ahead = -dot(ray.origin, ray.direction);
            const Vec3 nearest = ray.origin + ray.direction * ahead;
            const double exact = ahead - std::sqrt(1 - dot(nearest, nearest));
            const double found = facets.nearest(ray, -1, -1).distance;
            EXPECT_GE(found, exact - 1e-12) << "triangles are inside of the sphere";
            error = std::max(error, found - exact);
        }
        errors.push_back(error);
    }
    EXPECT_NEAR(errors[1] / errors[0], 0.25, 0.05);
    EXPECT_NEAR(errors[2] / errors[1], 0.25, 0.05);
    EXPECT_LT(errors[2], 2e-3);
}

/// Balls, a box, needles and ribbons, of which many share edges, planes and coordinates.
Scene crowd() {
    Scene scene;
    add_shape(scene, "sphere", 3, {1, {}, {0.3, 0, 0}}, matte(0.5));
    add_shape(scene, "box", 2, {0.5, {0, 45, 0}, {-1, 0, 0}}, matte(0.5));
    add_shape(scene, "box", 2, {2.5, {}, {}}, matte(0.5));
    add_shape(scene, "slivers", 1, {1, {}, {0, 0.5, 0}}, matte(0.5));
    add_shape(scene, "hair", 0, {0.4, {}, {0, -1, 0}}, matte(0.5));
    return scene;
}

/// Anywhere, along an axis, along one through coordinates of corners, in a plane of one, to a corner, to an
/// edge. (Which triangle a ray in the plane of one meets is up to rounding.)
PathRay hard_ray(const Facets& facets, SplitMix64& random, int kind) {
    const auto any = [&] { return 2 * random.uniform() - 1; };
    const auto facet = [&]() -> const Facet& {
        return facets[static_cast<int>(random.next() % static_cast<std::uint64_t>(facets.count()))];
    };
    const Vec3 anywhere = {2 * any(), 2 * any(), 2 * any()};
    if (kind == 0) return {anywhere, normalized({any(), any(), any()})};
    if (kind == 1) return {anywhere, {0, any() < 0 ? -1.0 : 1.0, 0}};
    if (kind == 2) return {{facet().a.x, facet().b.y, any()}, {-0.0, 0, 1}};
    if (kind == 3) return {{facet().a.x, any(), any()}, normalized({0, any(), any()})};
    if (kind == 4) return {anywhere, normalized(facet().c - anywhere)};
    const Facet& beside = facet();
    return {anywhere, normalized(beside.a + (beside.b - beside.a) * random.uniform() - anywhere)};
}

TEST(MeshOracle, rays_meet_through_the_tree_what_they_meet_among_all_triangles) {
    const Facets facets(crowd());
    SplitMix64 random(5);
    int met = 0;
    for (int i = 0; i < 3000; ++i) {
        const PathRay ray = hard_ray(facets, random, i % 6);
        const FacetHit found = facets.nearest(ray, -1, -1), right = facets.nearest_of_each(ray, -1, -1);
        ASSERT_EQ(found.facet, right.facet) << "kind " << i % 6;
        ASSERT_EQ(found.distance, right.distance);
        ASSERT_EQ(facets.nearest(ray, found.facet, -1).facet,
                  facets.nearest_of_each(ray, found.facet, -1).facet);
        met += right.facet >= 0 ? 1 : 0;
    }
    EXPECT_GT(met, 2500) << "rays are among triangles";
}

TEST(MeshOracle, triangles_in_the_same_place_make_a_tree_that_ends) {
    Scene scene;
    const auto one = square(1);
    std::vector<std::array<Vec3, 3>> many;
    for (int i = 0; i < 1000; ++i) many.push_back(one[0]);
    add_triangles(scene, many, matte(0.5));
    const Facets facets(scene);
    EXPECT_EQ(facets.nearest({{-0.5, 0.5, 0}, {0, 0, 1}}, -1, -1).facet, 0);
    EXPECT_EQ(facets.nearest({{-0.5, 0.5, 0}, {0, 0, 1}}, 0, 1).facet, 2);
    EXPECT_EQ(facets.nearest({{0.5, -0.5, 0}, {0, 0, 1}}, -1, -1).facet, -1);
}

TEST(MeshOracle, a_triangle_that_is_left_out_is_not_met) {
    Scene scene;
    add_triangles(scene, square(1), matte(0.5));
    add_triangles(scene, square(2), matte(0.5));
    const Facets facets(scene);
    const PathRay ray = {{0.5, -0.5, 0}, {0, 0, 1}};
    const int first = facets.nearest(ray, -1, -1).facet;
    EXPECT_EQ(facets.nearest(ray, -1, -1).distance, 1);
    EXPECT_EQ(facets.nearest(ray, first, -1).distance, 2);
    EXPECT_EQ(facets.nearest(ray, -1, first).distance, 2);
    EXPECT_EQ(facets.nearest(ray, first, facets.nearest(ray, first, -1).facet).facet, -1);
}

TEST(MeshOracle, a_flat_lamp_shines_from_both_sides_and_ends_the_path) {
    for (const double z : {10.0, -10.0}) {
        Scene scene = narrow_view();
        scene.camera.look_at = {0.1, 0.2, z};
        add_triangles(scene, square(10), lamp({3, 2, 1}));
        add_triangles(scene, square(-10), lamp({3, 2, 1}));
        for (auto* trace : {trace_pt, trace_direct, trace_whitted}) {
            const OracleResult result = trace(scene, job(2, 4, 128));
            expect_every_pixel(result.mean, {3, 2, 1});
            EXPECT_EQ(result.segments, 16U);
        }
    }
}

TEST(MeshOracle, a_flat_mirror_shows_what_is_behind_the_camera_in_its_tint) {
    Scene scene = narrow_view();
    scene.camera.look_at = {0.01, 0.02, 1};
    add_triangles(scene, square(10), mirror({0.5, 1, 0.25}));
    add(scene, {0, 0, -10}, 5, lamp({8, 4, 2}));
    for (auto* trace : {trace_pt, trace_direct, trace_whitted})
        expect_every_pixel(trace(scene, job(2, 4, 2)).mean, {4, 4, 0.5});
}

TEST(MeshOracle, a_square_lamp_lights_a_floor_by_its_configuration_factor) {
    // From a point to a parallel rectangle with a corner over it, of sides a and b at height 1: see any table
    // of configuration factors. Four of them make the square. The floor is a triangle.
    const double a = 0.5, root = std::sqrt(1 + a * a);
    const double factor = 4 * (2 / (2 * pi)) * a / root * std::atan(a / root);
    Scene scene;
    scene.camera = {{5, 0.1, 1}, {0, 0, 2}, {0, 1, 0}, 1e-4};
    add_triangles(scene, square(1, a), lamp({8, 8, 8}));
    add_triangles(scene, {{Vec3{-9, -9, 2}, Vec3{9, -9, 2}, Vec3{0.5, 9, 2}}}, matte(0.5));
    for (auto* trace : {trace_pt, trace_direct})
        expect_mean(trace(scene, job(8, 4000, 2)), 4000, 0.5 * 8 * factor);
}

TEST(MeshOracle, whitted_takes_each_triangle_of_a_lamp_as_a_point) {
    // Two triangles of area 1/8 with centroids at (+-1/12, -+1/12, 1): intensity Le A cos, both cosines 1 /
    // d.
    Scene scene;
    scene.camera = {{5, 0.1, 1}, {0, 0, 2}, {0, 1, 0}, 1e-4};
    add_triangles(scene, square(1, 0.25), lamp({8, 8, 8}));
    add_triangles(scene, {{Vec3{-9, -9, 2}, Vec3{9, -9, 2}, Vec3{0.5, 9, 2}}}, matte(0.5));
    const double d_squared = 1 + 2 / 144.0;
    expect_mean(trace_whitted(scene, job(2, 16, 2)), 16, 0.5 / pi * 8 * 0.25 / (d_squared * d_squared));
    add_triangles(scene, square(1.5, 0.5), glass(1.5));
    expect_mean(trace_whitted(scene, job(2, 16, 2)), 16, 0);
}

TEST(MeshOracle, glass_slab_of_triangles_reflects_and_passes_what_fresnel_says) {
    // Through both faces (1 - R)^2 / (1 - R^2) with R = 0.04; see TracePt.glass_ball_passes_the_rest...
    Scene scene = narrow_view();
    scene.camera.look_at = {0.01, 0.02, 1};
    add_shape(scene, "box", 1, {1, {}, {0, 0, 10}}, glass(1.5));
    add(scene, {0, 0, 30}, 5, lamp({1, 1, 1}));
    const int spp = 4000;
    Estimate found = estimate(trace_pt(scene, job(4, spp, 128)), spp);
    EXPECT_NEAR(found.mean, 0.96 * 0.96 / (1 - 0.04 * 0.04), 4 * found.standard_error + 1e-4);
    scene.spheres[0].centre.z = -10;
    found = estimate(trace_pt(scene, job(4, spp, 2)), spp);
    EXPECT_NEAR(found.mean, 0.04, 4 * found.standard_error + 1e-4);
}

TEST(MeshOracle, total_reflection_keeps_every_path_inside_a_glass_cube) {
    // Along the diagonal of a face all angles are 45 degrees or 90: beyond 41.8 at every bounce.
    Scene scene;
    scene.camera = {{0.3, 0.1, 0.2}, {1.3, 1.1, 0.2}, {0, 0, 1}, 1};
    add_shape(scene, "box", 1, {}, glass(1.5));
    const OracleResult result = trace_pt(scene, job(4, 4, 128));
    EXPECT_EQ(result.full_length_paths, 64U);
}

/// Balls of three materials in a lit room, as spheres or as triangles.
Scene balls(int detail) {
    Scene scene;
    scene.camera = {{0, 0, -8}, {0, 0, 0}, {0, 1, 0}, 45};
    add(scene, {0, 0, 0}, 20, glowing_wall({0.4, 0.5, 0.6}, {0.3, 0.3, 0.3}));
    add(scene, {0, 12, 0}, 5, lamp({5, 4, 3}));
    const std::vector<std::pair<Vec3, Material>> each = {
        {{-2.2, 0, 0}, matte(0.7)}, {{0, 0, 1}, glass(1.5)}, {{2.2, 0, 0}, mirror({0.9, 0.8, 0.7})}};
    for (const auto& [centre, material] : each) {
        if (detail < 0)
            add(scene, centre, 1, material);
        else
            add_shape(scene, "sphere", detail, {1, {}, centre}, material);
    }
    return scene;
}

TEST(MeshOracle, a_scene_of_tessellated_balls_comes_to_agree_with_that_of_spheres) {
    const int spp = 32;
    const auto render = [&](int detail) { return trace_pt(balls(detail), job(24, spp, 8)); };
    const OracleResult truth = render(-1), coarse = render(0), fine = render(3);
    for (const std::size_t channel : {0U, 2U}) {
        const auto difference_in_noise = [&](const OracleResult& result) {
            const Estimate found = estimate(result, spp, channel), right = estimate(truth, spp, channel);
            return std::abs(found.mean - right.mean) / std::hypot(found.standard_error, right.standard_error);
        };
        EXPECT_GT(difference_in_noise(coarse), 6) << "octahedra are no balls";
        EXPECT_LT(difference_in_noise(fine), 4);
    }
}

TEST(MeshOracle, shipped_scenes_with_meshes_are_seen_and_rooms_are_closed) {
    const std::set<std::string> open = {"cornell"};
    int with_meshes = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PTB_SOURCE_DIR) + "/configs/scenes")) {
        if (entry.path().extension() != ".json") continue;
        const Scene scene = load_scene(entry.path());
        if (scene.meshes.empty()) continue;
        SCOPED_TRACE(scene.name);
        ++with_meshes;
        const int spp = 4;
        const OracleResult result = trace_pt(scene, job(8, spp, 6));
        EXPECT_GT(estimate(result, spp).mean, 0.01) << "light is seen";
        EXPECT_GT(2 * result.segments, 3 * result.samples) << "paths bounce";
        // In a closed room a path ends at its length or at a lamp, so a black one is a full one.
        std::uint64_t black = 0;
        for (std::size_t i = 0; i < result.mean.rgb.size(); i += 3)
            black += result.mean.rgb[i] == 0 ? 1U : 0U;
        EXPECT_TRUE(open.contains(scene.name) || result.full_length_paths >= black * spp);
    }
    EXPECT_EQ(with_meshes, 7);
}

TEST(MeshOracle, the_thesis_tracer_refuses_meshes) {
    Scene scene = narrow_view();
    add_triangles(scene, square(1), matte(0.5));
    EXPECT_THROW(trace_thesis(scene, job(2, 1, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace ptb
