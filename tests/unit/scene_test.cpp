#include "core/scene/scene.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/input/usage_error.h"

namespace ptb {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

json good_scene() {
    return json::parse(R"({
        "name": "small",
        "camera": {"position": [0, 0, -5], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40},
        "materials": {
            "grey": {"type": "matte", "albedo": [0.5, 0.5, 0.5]},
            "lamp": {"type": "emitter", "radiance": [1, 2, 3]},
            "glass": {"type": "dielectric", "ior": 1.5},
            "metal": {"type": "mirror", "reflectance": [0, 0.5, 1]},
            "glow": {"type": "emitter", "radiance": [0, 0, 0], "albedo": [1, 1, 1]}},
        "spheres": [
            {"centre": [0, 0, 0], "radius": 1, "material": "grey"},
            {"centre": [0, 9, 0], "radius": 2.5, "material": "lamp"}],
        "meshes": [
            {"shape": "box", "detail": 0, "material": "glass",
             "transform": {"scale": 2, "rotate_deg": [0, 0, 90], "translate": [1, 0, 0]}}]})");
}

std::string error_of_text(const std::string& text) {
    try {
        parse_scene(text, "scene.json");
    } catch (const UsageError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "an error is one line";
        return error.what();
    }
    return "no error";
}

/// The error of the good scene with one value replaced or added.
std::string error_with(const std::string& pointer, const json& value) {
    json scene = good_scene();
    scene[json::json_pointer(pointer)] = value;
    return error_of_text(scene.dump());
}

std::string error_without(const std::string& parent, const std::string& key) {
    json scene = good_scene();
    scene[json::json_pointer(parent)].erase(key);
    return error_of_text(scene.dump());
}

TEST(Scene, reads_everything_that_a_file_states) {
    const Scene scene = parse_scene(good_scene().dump(), "scene.json");
    EXPECT_EQ(scene.name, "small");
    EXPECT_EQ(scene.camera.position, (Vec3{0, 0, -5}));
    EXPECT_EQ(scene.camera.fov_deg, 40);
    ASSERT_EQ(scene.spheres.size(), 2U);
    EXPECT_EQ(scene.spheres[1].centre, (Vec3{0, 9, 0}));
    EXPECT_EQ(scene.spheres[1].radius, 2.5);
    const Material& lamp = scene.materials[static_cast<std::size_t>(scene.spheres[1].material)];
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.type, MaterialType::emitter);
    EXPECT_EQ(lamp.radiance, (Vec3{1, 2, 3}));
}

TEST(Scene, only_an_emitter_without_albedo_ends_paths) {
    for (const Material& material : parse_scene(good_scene().dump(), "scene.json").materials)
        EXPECT_EQ(material.scatters, material.name != "lamp") << material.name;
}

TEST(Scene, every_scene_that_comes_along_loads_and_is_named_like_its_file) {
    const std::filesystem::path folder = std::filesystem::path(PTB_SOURCE_DIR) / "configs/scenes";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        EXPECT_EQ(load_scene(entry.path()).name, entry.path().stem().string());
    }
}

TEST(Scene, a_bad_number_is_named_with_its_pointer_and_the_rule) {
    EXPECT_EQ(error_with("/spheres/1/radius", -2),
              "scene.json: /spheres/1/radius: found -2; allowed: a finite number > 0 (from 1e-18 to 1e18)");
    EXPECT_THAT(error_with("/spheres/1/radius", 0), HasSubstr("/spheres/1/radius: found 0"));
    EXPECT_THAT(error_with("/spheres/0/centre/2", 1e30), HasSubstr("/spheres/0/centre/2: found 1e+30"));
    EXPECT_THAT(error_with("/materials/grey/albedo/0", 1.01),
                HasSubstr("/materials/grey/albedo/0: found 1.01"));
    EXPECT_THAT(error_with("/materials/grey/albedo/0", -0.1), HasSubstr("[0, 1]"));
    EXPECT_THAT(error_with("/materials/metal/reflectance/1", 2), HasSubstr("/materials/metal/reflectance/1"));
    EXPECT_THAT(error_with("/materials/glow/albedo/1", 2), HasSubstr("/materials/glow/albedo/1"));
    EXPECT_THAT(error_with("/materials/lamp/radiance/0", -1), HasSubstr("a finite number >= 0"));
    EXPECT_THAT(error_with("/materials/glass/ior", 0), HasSubstr("/materials/glass/ior: found 0"));
    for (const double fov : {-40.0, 0.0, 180.0, 400.0})
        EXPECT_THAT(error_with("/camera/fov_deg", fov), HasSubstr("between 0 and 180 degrees"));
}

TEST(Scene, a_wrong_type_is_refused_where_it_stands) {
    EXPECT_THAT(error_with("/spheres/1/radius", "wide"), HasSubstr("/spheres/1/radius: found \"wide\""));
    EXPECT_THAT(error_with("/spheres/1/radius", nullptr), HasSubstr("/spheres/1/radius: found null"));
    EXPECT_THAT(error_with("/spheres/0/centre", {1, 2}), HasSubstr("/spheres/0/centre: found an array"));
    EXPECT_THAT(error_with("/spheres/0/centre", {1, true, 2}), HasSubstr("/spheres/0/centre/1: found true"));
    EXPECT_THAT(error_with("/spheres/0", 7), HasSubstr("/spheres/0: found 7"));
    EXPECT_THAT(error_with("/spheres", json::object()), HasSubstr("/spheres: found {}"));
    EXPECT_THAT(error_with("/materials", json::array()), HasSubstr("/materials: found []"));
    EXPECT_THAT(error_with("/materials/grey/type", 3), HasSubstr("/materials/grey/type: found 3"));
    EXPECT_THAT(error_with("/camera", "x"), HasSubstr("/camera: found \"x\""));
    EXPECT_THAT(error_of_text("[]"), HasSubstr("scene.json: found []"));
}

TEST(Scene, a_name_that_is_no_plain_file_name_is_refused) {
    for (const char* name : {"", "../up", "a/b", ".hidden", "-flag", "a b", "a\nb", "\xc3\xa9"})
        EXPECT_THAT(error_with("/name", name), HasSubstr("/name: ")) << name;
    EXPECT_THAT(error_with("/name", std::string(65, 'a')), HasSubstr("1 to 64 letters"));
}

TEST(Scene, an_unknown_key_gets_the_nearest_known_one) {
    EXPECT_EQ(error_with("/spheres/0/raduis", 1),
              "scene.json: /spheres/0/raduis: unknown key; did you mean radius?");
    EXPECT_THAT(error_with("/camra", 1), HasSubstr("/camra: unknown key; did you mean camera?"));
    EXPECT_THAT(error_with("/camera/fov", 1),
                HasSubstr("unknown key; allowed: position, look_at, up, fov_deg"));
    EXPECT_THAT(error_with("/materials/grey/ior", 1.5), HasSubstr("unknown key; allowed: type, albedo"));
    EXPECT_THAT(error_with("/materials/glass/albedo", 1), HasSubstr("unknown key; allowed: type, ior"));
    EXPECT_THAT(error_with("/materials/grey/type", "mate"), HasSubstr("did you mean matte?"));
}

TEST(Scene, a_missing_key_is_named) {
    EXPECT_EQ(error_without("/spheres/1", "radius"), "scene.json: /spheres/1: \"radius\" is missing");
    EXPECT_THAT(error_without("", "camera"), HasSubstr("\"camera\" is missing"));
    EXPECT_THAT(error_without("/camera", "up"), HasSubstr("/camera: \"up\" is missing"));
    EXPECT_THAT(error_without("/materials/grey", "type"), HasSubstr("/materials/grey: \"type\""));
    EXPECT_THAT(error_without("/materials/glass", "ior"), HasSubstr("/materials/glass: \"ior\""));
}

TEST(Scene, an_undefined_material_is_answered_with_the_defined_ones) {
    const std::string error = error_with("/spheres/0/material", "gray");
    EXPECT_THAT(error, HasSubstr("/spheres/0/material: found \"gray\""));
    EXPECT_THAT(error, HasSubstr("glass, glow, grey, lamp, metal"));
}

TEST(Scene, needs_a_sphere_or_a_mesh) {
    EXPECT_EQ(error_with("/spheres", json::array()), "no error") << "there is a mesh";
    EXPECT_EQ(error_without("", "meshes"), "no error") << "there are spheres";
    json empty = good_scene();
    empty["spheres"] = json::array();
    empty.erase("meshes");
    EXPECT_THAT(error_of_text(empty.dump()),
                HasSubstr("/spheres: found []; allowed: a list of at least one sphere, or else \"meshes\""));
}

TEST(Scene, spheres_in_the_same_place_are_refused_where_it_matters_which_is_met_first) {
    const auto twin_of = [](const char* first, const char* second) {
        json scene = good_scene();
        scene["spheres"] = {{{"centre", {0, 0, 0}}, {"radius", 9}, {"material", "grey"}},
                            {{"centre", {0, 2, 0}}, {"radius", 1}, {"material", first}},
                            {{"centre", {-0.0, 2, 0}}, {"radius", 1}, {"material", second}}};
        return error_of_text(scene.dump());
    };
    EXPECT_EQ(
        twin_of("glass", "glass"),
        "scene.json: /spheres/2: spheres 1 and 2 are the same; allowed: twice the same of one material, "
        "matte or mirror");
    for (const char* other : {"grey", "lamp", "metal"}) {
        EXPECT_THAT(twin_of("glass", other), HasSubstr("/spheres/2: ")) << other;
        EXPECT_THAT(twin_of(other, "glow"), HasSubstr("/spheres/2: ")) << other;
        if (std::string(other) != "lamp")
            EXPECT_EQ(twin_of(other, other), "no error") << "no path can tell";
        else
            EXPECT_THAT(twin_of(other, other), HasSubstr("/spheres/2: ")) << "each is asked for its light";
    }
    EXPECT_EQ(error_with("/spheres/1", {{"centre", {0, 0, 0}}, {"radius", 1.5}, {"material", "glass"}}),
              "no error")
        << "a shell is no twin";
}

TEST(Scene, a_camera_that_sees_nothing_is_refused) {
    EXPECT_THAT(error_with("/camera/look_at", {0, 0, -5}), HasSubstr("/camera/look_at: "));
    EXPECT_THAT(error_with("/camera/up", {0, 0, 3}), HasSubstr("/camera/up: found an array"));
    EXPECT_THAT(error_with("/camera/up", {0, 0, 0}), HasSubstr("not zero"));
}

TEST(Scene, what_is_no_number_in_json_is_refused_with_line_and_column) {
    for (const char* word : {"NaN", "Infinity", "-Infinity", "nan", "0x10", "+1", "01"}) {
        const std::string text = std::string("{\n  \"name\": ") + word + "}";
        EXPECT_THAT(error_of_text(text), AllOf(StartsWith("scene.json: "), HasSubstr("line 2"))) << word;
    }
    EXPECT_THAT(error_of_text("{\"name\": 1e999}"), AllOf(StartsWith("scene.json: "), HasSubstr("1e999")));
}

TEST(Scene, text_cut_off_anywhere_is_an_error) {
    const std::string text = good_scene().dump(1);
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_THAT(error_of_text(text.substr(0, length)), StartsWith("scene.json: ")) << length;
}

TEST(Scene, hostile_nesting_is_refused_and_does_not_crash) {
    EXPECT_THAT(error_of_text(std::string(1'000'000, '[')), HasSubstr("nested deeper than 64"));
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    EXPECT_THAT(error_of_text(objects), HasSubstr("nested deeper than 64"));
    const auto lists = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
    EXPECT_THAT(error_of_text(lists(64)), HasSubstr("found an array"));
    EXPECT_THAT(error_of_text(lists(65)), HasSubstr("nested deeper than 64"));
}

TEST(Scene, a_key_given_twice_is_refused) {
    std::string text = good_scene().dump();
    text.insert(1, "\"name\": \"other\",");
    EXPECT_EQ(error_of_text(text), "scene.json: key \"name\" comes twice in an object");
}

TEST(Scene, unprintable_keys_do_not_break_the_line) {
    EXPECT_THAT(error_with("/a\nb\x1b[2J", 1), Not(HasSubstr("\x1b")));
    EXPECT_THAT(error_with("/spheres/0/material", "\n"), HasSubstr("found "));
    EXPECT_THAT(error_of_text("{\"\xff\": 1}"), StartsWith("scene.json: "));
    EXPECT_LT(error_with("/" + std::string(100'000, 'k'), 1).size(), 500U);
}

TEST(Scene, a_file_that_cannot_be_read_is_named_with_the_reason) {
    for (const std::string file : {"/no/such/scene.json", PTB_SOURCE_DIR}) {
        try {
            load_scene(file);
            ADD_FAILURE() << file;
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), StartsWith("cannot read " + file + ": "));
        }
    }
}

TEST(Scene, an_empty_file_is_named_as_such) {
    EXPECT_THAT(error_of_text(""),
                testing::AnyOf(HasSubstr("unexpected end of input"), HasSubstr("empty input")));
}

/// The reader and the published schema must not drift apart.
class SceneSchema : public ::testing::Test {
  protected:
    SceneSchema() {
        std::ifstream stream(std::filesystem::path(PTB_SOURCE_DIR) / "configs/schema/scene.schema.json");
        schema_ = json::parse(stream);
    }
    const json& at(const std::string& pointer) const { return schema_.at(json::json_pointer(pointer)); }

    /// The reader takes the schema's bounds and nothing beyond.
    void expect_bounds(const std::string& value, const std::string& rule) const {
        const double least = at(rule + "/minimum").get<double>(), most = at(rule + "/maximum").get<double>();
        EXPECT_EQ(error_with(value, least), "no error") << value;
        EXPECT_EQ(error_with(value, most), "no error") << value;
        EXPECT_THAT(error_with(value, std::nextafter(least, -1e300)), HasSubstr(value + ": "));
        EXPECT_THAT(error_with(value, std::nextafter(most, 1e300)), HasSubstr(value + ": "));
    }

    json schema_;
};

TEST_F(SceneSchema, bounds_are_those_of_the_reader) {
    expect_bounds("/spheres/0/centre/0", "/$defs/coordinates/items");
    expect_bounds("/camera/position/0", "/$defs/coordinates/items");
    expect_bounds("/spheres/0/radius", "/$defs/sphere/properties/radius");
    expect_bounds("/materials/grey/albedo/0", "/$defs/shares/items");
    expect_bounds("/materials/metal/reflectance/0", "/$defs/shares/items");
    expect_bounds("/materials/glow/albedo/0", "/$defs/shares/items");
    expect_bounds("/materials/lamp/radiance/0", "/$defs/radiance/items");
    expect_bounds("/meshes/0/transform/scale", "/$defs/transform/properties/scale");
    expect_bounds("/meshes/0/transform/rotate_deg/1", "/$defs/transform/properties/rotate_deg/items");
    expect_bounds("/materials/glass/ior", "/$defs/material/oneOf/2/properties/ior");
    EXPECT_EQ(error_with("/camera/fov_deg", std::nextafter(180.0, 0.0)), "no error");
}

TEST_F(SceneSchema, keys_are_those_of_the_reader) {
    const auto expect_keys = [this](const std::string& parent, const std::string& rule) {
        for (const auto& key : schema_.value(json::json_pointer(rule + "/required"), json::array()))
            EXPECT_THAT(error_without(parent, key), HasSubstr("is missing")) << parent << " " << key;
        for (const auto& item : at(rule + "/properties").items())
            EXPECT_THAT(error_with(parent + "/" + item.key(), json::array()), Not(HasSubstr("unknown key")));
        EXPECT_FALSE(at(rule + "/additionalProperties").get<bool>());
    };
    expect_keys("", "");
    expect_keys("/camera", "/$defs/camera");
    expect_keys("/spheres/0", "/$defs/sphere");
    expect_keys("/meshes/0", "/$defs/mesh");
    expect_keys("/meshes/0/transform", "/$defs/transform");
    expect_keys("/materials/grey", "/$defs/material/oneOf/0");
    expect_keys("/materials/metal", "/$defs/material/oneOf/1");
    expect_keys("/materials/glass", "/$defs/material/oneOf/2");
    expect_keys("/materials/glow", "/$defs/material/oneOf/3");
}

}  // namespace
}  // namespace ptb
