// Meshes made from formulas: closed where they should be, as large and as many as the formulas say.
#include "core/mesh/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/source/text_hash.h"

namespace ptb {
namespace {

using std::numbers::pi;

const Shape& shape_named(const std::string& name) {
    const auto is_it = [&](const Shape& shape) { return shape.name == name; };
    return *std::find_if(shapes().begin(), shapes().end(), is_it);
}

Geometry made(const std::string& name, int detail) { return shape_named(name).make(detail); }

double least_area(const Geometry& geometry) {
    double least = 1e300;
    for (const Face& face : geometry.faces())
        least = std::min(least, area(geometry.vertices()[face[0]], geometry.vertices()[face[1]],
                                     geometry.vertices()[face[2]]));
    return least;
}

double total_area(const Geometry& geometry) {
    double sum = 0;
    for (const Face& face : geometry.faces())
        sum += area(geometry.vertices()[face[0]], geometry.vertices()[face[1]], geometry.vertices()[face[2]]);
    return sum;
}

TEST(Shapes, have_as_many_triangles_as_their_formulas_say) {
    const auto expect = [](const std::string& name, std::initializer_list<std::size_t> counts) {
        int detail = 0;
        for (const std::size_t count : counts) {
            EXPECT_EQ(shape_named(name).triangles(detail), count) << name;
            EXPECT_EQ(made(name, detail++).faces().size(), count) << name;
        }
    };
    expect("box", {12, 48, 192});
    expect("sphere", {8, 32, 128, 512});
    expect("flake", {6560, 26240});
    expect("knot", {1024, 4096});
    expect("menger", {12, 144, 2112, 36096});  // 2 (2 x 20^n + 4 x 8^n)
    expect("hair", {1280, 5120});
    expect("slivers", {128, 512, 2048, 8192});
    expect("terrain", {2, 8, 32, 128});
}

TEST(Shapes, that_are_closed_are_wound_outwards_and_others_are_open) {
    const std::set<std::string> open = {"hair", "slivers", "terrain"};
    for (const Shape& shape : shapes())
        for (const int detail : {0, 1, 2}) {
            SCOPED_TRACE(shape.name + " " + std::to_string(detail));
            const Geometry geometry = shape.make(detail);
            EXPECT_EQ(loose_edge(geometry).has_value(), open.contains(shape.name));
            EXPECT_GT(least_area(geometry), 0);
            EXPECT_TRUE(open.contains(shape.name) || signed_volume(geometry) > 0);
            for (const Vec3& v : geometry.vertices())
                EXPECT_LE(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}), 3);
        }
}

TEST(Shapes, closed_surfaces_have_the_characteristic_of_their_kind) {
    // Vertices - edges + faces; an edge has two faces, so edges = 3 faces / 2.
    const auto characteristic = [](const Geometry& geometry) {
        return static_cast<int>(geometry.vertices().size()) - static_cast<int>(geometry.faces().size()) / 2;
    };
    for (const int detail : {0, 1, 3}) {
        EXPECT_EQ(characteristic(made("box", detail)), 2);
        EXPECT_EQ(characteristic(made("sphere", detail)), 2);
        EXPECT_EQ(characteristic(made("knot", std::min(detail, 2))), 0) << "a ring";
    }
    EXPECT_EQ(characteristic(made("menger", 0)), 2);
    EXPECT_EQ(characteristic(made("menger", 1)), 2 - 2 * 5) << "five handles";
}

TEST(Shapes, enclose_the_volume_of_what_they_are_shapes_of) {
    EXPECT_DOUBLE_EQ(signed_volume(made("box", 2)), 8);
    EXPECT_DOUBLE_EQ(total_area(made("box", 2)), 24);
    EXPECT_DOUBLE_EQ(signed_volume(made("sphere", 0)), 4.0 / 3) << "an octahedron";
    EXPECT_NEAR(signed_volume(made("sphere", 5)), 4 * pi / 3, 0.01);
    EXPECT_NEAR(total_area(made("sphere", 5)), 4 * pi, 0.02);
    for (const int level : {0, 1, 2, 3})
        EXPECT_NEAR(signed_volume(made("menger", level)), 8 * std::pow(20.0 / 27, level), 1e-9);
    const double ball = signed_volume(made("sphere", 2)) / 8;  // radius 1/2; nine of a third each: 9 / 27
    EXPECT_NEAR(signed_volume(made("flake", 2)), ball * (1 + 1.0 / 3 + 1.0 / 9 + 1.0 / 27), 1e-9);
}

TEST(Shapes, the_knots_tube_holds_its_section_times_its_length) {
    // See "Theorems of Pappus and Guldin". The length is summed by steps of the knot's formula.
    const int steps = 100'000;
    const auto at = [](double t) {
        const double r = 0.6 + 0.3 * std::cos(3 * t);
        return Vec3{r * std::cos(2 * t), r * std::sin(2 * t), 0.3 * std::sin(3 * t)};
    };
    double knot_length = 0;
    for (int i = 0; i < steps; ++i)
        knot_length += length(at(2 * pi * (i + 1) / steps) - at(2 * pi * i / steps));
    EXPECT_NEAR(signed_volume(made("knot", 3)) / (pi * 0.01 * knot_length), 1, 0.01);
}

TEST(Shapes, slivers_are_long_and_thin_and_hair_is_narrow) {
    const Geometry slivers = made("slivers", 0);
    for (const Face& face : slivers.faces()) {
        const Vec3 &a = slivers.vertices()[face[0]], &b = slivers.vertices()[face[1]],
                   &c = slivers.vertices()[face[2]];
        EXPECT_GE(length(b - a) / length(c - a), 99);
    }
    EXPECT_NEAR(total_area(made("hair", 1)) / total_area(made("hair", 0)), 2, 0.1);
}

TEST(Shapes, terrain_keeps_its_form_as_it_becomes_finer) {
    const Geometry coarse = made("terrain", 4), fine = made("terrain", 7);
    const auto height_at = [](const Geometry& terrain, double x, double z) {
        for (const Vec3& v : terrain.vertices())
            if (v.x == x && v.z == z) return v.y;
        return 1e300;
    };
    for (const double x : {-1.0, -0.5, 0.125, 1.0})
        EXPECT_NEAR(height_at(coarse, x, 0.25), height_at(fine, x, 0.25), 0.3 / 16 * 2);
}

/// Bits of all corners.
std::string hash_of(const Geometry& geometry) {
    std::string bytes;
    for (const Face& face : geometry.faces())
        for (const std::uint32_t vertex : face) {
            char part[sizeof(Vec3)];
            std::memcpy(part, &geometry.vertices()[vertex], sizeof(Vec3));
            bytes.append(part, sizeof(Vec3));
        }
    return text_hash(bytes);
}

TEST(Shapes, are_the_same_bits_everywhere) {
    // Breaks when a shape changes, which makes other scenes of all that use it, or when a machine computes
    // otherwise.
    const std::vector<std::pair<std::string, std::string>> expected = {
        {"box", "1cbb8174a20629a5"},     {"sphere", "05f521600be03325"}, {"flake", "7c308fa2ddddf619"},
        {"knot", "e24fbb0954fd00d1"},    {"menger", "be9d5465097eeb65"}, {"hair", "a7e1657e1bbd4f5c"},
        {"slivers", "528ca0ad24971470"}, {"terrain", "48ec0d945e66323e"}};
    for (const auto& [name, hash] : expected) EXPECT_EQ(hash_of(made(name, 1)), hash) << name;
    EXPECT_EQ(expected.size(), shapes().size());
}

TEST(Shapes, are_those_of_the_schema) {
    std::ifstream stream(std::string(PTB_SOURCE_DIR) + "/configs/schema/scene.schema.json");
    const auto schema = nlohmann::json::parse(stream);
    std::vector<std::string> names;
    for (const Shape& shape : shapes()) names.push_back(shape.name);
    EXPECT_EQ(schema.at(nlohmann::json::json_pointer("/$defs/mesh/properties/shape/enum")), names);
}

}  // namespace
}  // namespace ptb
