#include "core/scene/lamps.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace ptb {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double pi = std::numbers::pi;

Material of_type(MaterialType type) {
    Material material;
    material.type = type;
    return material;
}

Material glowing(const Vec3& radiance) {
    Material material = of_type(MaterialType::emitter);
    material.radiance = radiance;
    return material;
}

/// A lamp at the origin, and the camera ten units away.
Scene scene_of_lamp(double radius, const Vec3& radiance = {1, 2, 3}) {
    Scene scene;
    scene.camera.position = {0, 0, -10};
    scene.materials = {glowing(radiance), of_type(MaterialType::matte), of_type(MaterialType::dielectric)};
    scene.spheres = {{{0, 0, 0}, radius, 0}};
    return scene;
}

const int matte = 1, dielectric = 2;  // materials of `scene_of_lamp`

/// The only lamp of a lamp and one other sphere.
Lamp lamp_beside(double radius, const Sphere& other) {
    Scene scene = scene_of_lamp(radius);
    scene.spheres.push_back(other);
    const Lamps found = find_lamps(scene);
    EXPECT_THAT(found.lamps, SizeIs(1));
    return found.lamps.empty() ? Lamp{} : found.lamps[0];
}

Vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> gauss;
    const double x = gauss(random), y = gauss(random), z = gauss(random);
    return normalized({x, y, z});
}

/// Whether a point is on the camera's side of a sphere.
bool is_open(const Vec3& point, const Vec3& camera, const Sphere& other) {
    return (length(point - other.centre) < other.radius) == (length(camera - other.centre) < other.radius);
}

/// Of points spread evenly over the first sphere: the share on the camera's side of the second, its standard
/// error, and their mean direction.
struct Shown {
    double share = 0, standard_error = 0;
    Vec3 axis;
};

Shown sampled(const Scene& scene, int points, std::mt19937& random) {
    const Sphere &lamp = scene.spheres[0], &other = scene.spheres[1];
    int open = 0;
    Vec3 sum;
    for (int i = 0; i < points; ++i) {
        const Vec3 direction = random_direction(random);
        if (!is_open(lamp.centre + direction * lamp.radius, scene.camera.position, other)) continue;
        ++open;
        sum = sum + direction;
    }
    const double share = static_cast<double>(open) / points;
    return {share, std::sqrt(share * (1 - share) / points), sum};
}

TEST(Lamps, caps_have_the_area_and_axis_of_points_that_show) {
    // Balls and rooms of random size around a lamp that they cut.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    for (int trial = 0; trial < 60; ++trial) {
        Scene scene = scene_of_lamp(0.2 + uniform(random));
        const double a = scene.spheres[0].radius, r = 0.3 + (trial % 2 == 0 ? 3 : 30) * uniform(random);
        const double apart = std::abs(r - a) + 2 * std::min(r, a) * (0.1 + 0.8 * uniform(random));
        scene.spheres.push_back({random_direction(random) * apart, r, matte});
        scene.camera.position = scene.spheres[1].centre + Vec3{0, 0, (trial % 3 == 0 ? 0.5 : 2) * r};
        if (length(scene.camera.position) <= a) continue;
        const int points = 20000;
        const Shown truth = sampled(scene, points, random);
        const Lamps found = find_lamps(scene);
        ASSERT_THAT(found.lamps, SizeIs(1));
        const Lamp& lamp = found.lamps[0];
        const double share = lamp.area / (4 * pi * a * a);
        EXPECT_EQ(lamp.kind, LampKind::cap);
        EXPECT_NEAR(share, truth.share, 5 * truth.standard_error + 1e-3);
        EXPECT_NEAR(share, (1 - lamp.cos_rim) / 2, 1e-12);
        EXPECT_NEAR(length(lamp.axis), 1, 1e-12);
        if (share > 0.02 && share < 0.9) {
            EXPECT_GT(dot(lamp.axis, normalized(truth.axis)), 0.99);
        }
    }
}

TEST(Lamps, a_lamp_that_hangs_free_shows_all_of_itself) {
    const Scene scene = scene_of_lamp(2, {1, 2, 6});
    const Lamps found = find_lamps(scene);
    ASSERT_THAT(found.lamps, SizeIs(1));
    EXPECT_EQ(found.lamps[0].kind, LampKind::free);
    EXPECT_EQ(found.lamps[0].cos_rim, -1);
    EXPECT_DOUBLE_EQ(found.lamps[0].area, 4 * pi * 4);
    EXPECT_DOUBLE_EQ(found.lamps[0].power, 4 * pi * 4 * pi * 3);
    EXPECT_EQ(found.choice.pdf, std::vector<double>{1});
}

TEST(Lamps, spheres_apart_around_or_within_hide_nothing) {
    EXPECT_EQ(lamp_beside(1, {{0, 5, 0}, 4, matte}).kind, LampKind::free) << "touches";
    EXPECT_EQ(lamp_beside(1, {{0, 9, 0}, 4, matte}).kind, LampKind::free) << "apart";
    EXPECT_EQ(lamp_beside(1, {{0, 0.2, 0}, 0.5, matte}).kind, LampKind::free) << "within";
    EXPECT_EQ(lamp_beside(1, {{0, 0, 0}, 0.5, matte}).kind, LampKind::free) << "within, same centre";
    EXPECT_EQ(lamp_beside(1, {{0, 0, 0}, 40, matte}).kind, LampKind::free) << "a room, same centre";
    EXPECT_EQ(lamp_beside(1, {{3, 0, 0}, 40, matte}).kind, LampKind::free) << "a room";
}

TEST(Lamps, glass_hides_nothing) {
    EXPECT_EQ(lamp_beside(1, {{0, 0, 0}, 3, dielectric}).kind, LampKind::free);
    EXPECT_EQ(lamp_beside(1, {{0, 2, 0}, 2, dielectric}).kind, LampKind::free);
}

TEST(Lamps, what_is_hidden_is_no_lamp) {
    for (const Sphere& hider : {Sphere{{0, 0, 0}, 3, matte}, Sphere{{0, 1, 0}, 2, matte}}) {
        Scene scene = scene_of_lamp(1);
        scene.spheres.push_back(hider);
        EXPECT_THAT(find_lamps(scene).lamps, IsEmpty()) << "in a ball";
    }
    Scene scene = scene_of_lamp(1);
    scene.spheres.push_back({{0, 0, -50}, 45, matte});
    EXPECT_THAT(find_lamps(scene).lamps, IsEmpty()) << "outside of the room";
    EXPECT_THAT(find_lamps(scene_of_lamp(1, {0, 0, 0})).lamps, IsEmpty()) << "dark";
}

TEST(Lamps, the_sphere_that_hides_most_makes_the_cap) {
    Scene scene = scene_of_lamp(1);
    scene.spheres.push_back({{0, 100.5, 0}, 100, matte});
    scene.spheres.push_back({{100.2, 0, 0}, 100, matte});
    scene.spheres.push_back({{0, 0, 100.8}, 100, matte});
    EXPECT_EQ(find_lamps(scene).lamps.at(0).axis, (Vec3{-1, 0, 0}));
}

TEST(Lamps, lamps_around_the_camera_are_told_and_never_chosen) {
    Scene scene = scene_of_lamp(1);
    scene.spheres.push_back({{0, 0, 0}, 50, 0});
    const Lamps found = find_lamps(scene);
    ASSERT_THAT(found.lamps, SizeIs(2));
    EXPECT_FALSE(found.lamps[0].around_camera);
    EXPECT_TRUE(found.lamps[1].around_camera);
    EXPECT_THAT(found.choice.pdf, testing::ElementsAre(1, 0));
    EXPECT_THAT(found.choice.probability, testing::ElementsAre(1, 0));
    EXPECT_THAT(found.choice.alias, Each(0));
    scene.spheres.erase(scene.spheres.begin());
    EXPECT_THAT(find_lamps(scene).choice.pdf, IsEmpty()) << "nothing to choose";
}

TEST(Lamps, of_the_thesis_lamp_the_cap_under_the_ceiling_shows) {
    // The ceiling's ball, radius 10 000, cuts it; the flat ceiling that the ball stands for would leave 1/8.
    const Scene scene = load_scene(std::string(PTB_SOURCE_DIR) + "/configs/scenes/thesis.json");
    const Lamps found = find_lamps(scene);
    ASSERT_THAT(found.lamps, SizeIs(1));
    const double apart = std::hypot(9940, 277.5), a = 80, r = 10000;
    const double cos_rim = (r * r - apart * apart - a * a) / (2 * apart * a);  // law of cosines
    EXPECT_NEAR(found.lamps[0].cos_rim, cos_rim, 1e-9);
    EXPECT_NEAR((1 - cos_rim) / 2, 0.150, 0.001);
    EXPECT_NEAR(found.lamps[0].axis.y, -9940 / apart, 1e-12);
}

TEST(Lamps, a_thousand_are_chosen_by_their_power) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform;
    Scene scene = scene_of_lamp(1);
    for (int i = 1; i < 1000; ++i) {
        const double radius = 0.1 + 0.4 * uniform(random);
        scene.spheres.push_back({{3.0 * (i % 10), 3.0 * (i / 10 % 10), 3.0 * (i / 100)}, radius, 0});
    }
    const Lamps found = find_lamps(scene);
    ASSERT_THAT(found.lamps, SizeIs(1000));
    double squares = 0;
    for (const Sphere& sphere : scene.spheres) squares += sphere.radius * sphere.radius;
    for (std::size_t i = 0; i < 1000; ++i) {
        const double radius = scene.spheres[i].radius;
        EXPECT_NEAR(found.choice.pdf[i], radius * radius / squares, 1e-15);
    }
}

/// What a table draws, worked out from its columns.
std::vector<double> drawn(const AliasTable& table) {
    std::vector<double> pdf(table.pdf.size());
    for (std::size_t i = 0; i < pdf.size(); ++i) {
        const double column = 1 / static_cast<double>(pdf.size());
        pdf[i] += column * table.probability[i];
        pdf.at(static_cast<std::size_t>(table.alias[i])) += column * (1 - table.probability[i]);
    }
    return pdf;
}

TEST(AliasTable, draws_what_its_pdf_says) {
    std::mt19937 random(11);
    std::exponential_distribution<double> exponential;
    for (int size = 1; size < 300; size += size < 10 ? 1 : 7) {
        std::vector<double> weights;
        for (int i = 0; i < size; ++i)
            weights.push_back(i % 4 == 0 && size > 1 ? 0 : std::pow(exponential(random), 4));
        const AliasTable table = make_alias_table(weights);
        const std::vector<double> pdf = drawn(table);
        const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
        for (std::size_t i = 0; i < weights.size(); ++i) {
            EXPECT_NEAR(table.pdf[i], weights[i] / total, 1e-15);
            EXPECT_NEAR(pdf[i], table.pdf[i], 1e-13);
            if (weights[i] == 0) {
                EXPECT_EQ(pdf[i], 0) << "drawn, but of no weight";
            }
        }
        EXPECT_NEAR(std::accumulate(table.pdf.begin(), table.pdf.end(), 0.0), 1, 1e-12);
    }
}

TEST(AliasTable, equal_weights_need_no_alias) {
    EXPECT_THAT(make_alias_table({2, 2, 2}).probability, Each(1));
}

TEST(AliasTable, nothing_to_draw_is_an_empty_table) {
    EXPECT_THAT(make_alias_table({}).pdf, IsEmpty());
    EXPECT_THAT(make_alias_table({0, 0}).pdf, IsEmpty());
}

}  // namespace
}  // namespace ptb
