// Meshes of scene files: what is taken, where it is put, and what is refused.
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/input/usage_error.h"
#include "core/mesh/transform.h"
#include "core/scene/scene.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A folder for files of meshes, gone with the test.
class MeshOfScene : public ::testing::Test {
  protected:
    MeshOfScene() { fs::create_directories(folder_); }
    ~MeshOfScene() override { fs::remove_all(folder_); }

    std::string text_of(const json& mesh) const {
        const json scene = {
            {"name", "meshes"},
            {"camera",
             {{"position", {0, 0, -5}}, {"look_at", {0, 0, 0}}, {"up", {0, 1, 0}}, {"fov_deg", 40}}},
            {"materials",
             {{"grey", {{"type", "matte"}, {"albedo", {0.5, 0.5, 0.5}}}},
              {"glass", {{"type", "dielectric"}, {"ior", 1.5}}}}},
            {"spheres", json::array()},
            {"meshes", {mesh}}};
        return scene.dump();
    }
    Mesh read(const json& mesh) const {
        return parse_scene(text_of(mesh), "scene.json", {.folder = folder_}).meshes.at(0);
    }
    Mesh read_file(const std::string& name, const std::string& text,
                   const std::string& material = "grey") const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return read({{"file", name}, {"material", material}});
    }

    const fs::path folder_ = fs::path(PTB_BINARY_DIR) / "mesh_test" /
                             ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

const std::string obj_triangle = "v 0 0 0\nv 4 0 0\nv 0 3 0\nf 1 2 3\n";

TEST_F(MeshOfScene, comes_from_a_file_beside_the_scene_file) {
    const Mesh mesh = read_file("one.obj", obj_triangle);
    EXPECT_EQ(mesh.name, "one.obj");
    EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}));
    EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}}));
    EXPECT_EQ(mesh.dropped, Dropped{});
}

TEST_F(MeshOfScene, is_scaled_then_turned_about_x_y_and_z_then_moved) {
    const auto placed = [](const Transform& transform) { return Placing(transform)({1, 2, 3}); };
    EXPECT_EQ(placed({}), (Vec3{1, 2, 3}));
    EXPECT_EQ(placed({2, {}, {10, 20, 30}}), (Vec3{12, 24, 36}));
    EXPECT_EQ(placed({1, {90, 0, 0}, {}}), (Vec3{1, -3, 2})) << "y goes to z";
    EXPECT_EQ(placed({1, {0, 90, 0}, {}}), (Vec3{3, 2, -1})) << "z goes to x";
    EXPECT_EQ(placed({1, {0, 0, 90}, {}}), (Vec3{-2, 1, 3})) << "x goes to y";
    EXPECT_EQ(placed({1, {0, 0, -270}, {}}), (Vec3{-2, 1, 3}));
    EXPECT_EQ(placed({2, {90, 90, 90}, {1, 1, 1}}), (Vec3{7, 5, -1}));
    const Vec3 turned = Placing({1, {0, 0, 30}, {}})({2, 0, 7});
    EXPECT_NEAR(turned.x, std::sqrt(3), 1e-15);
    EXPECT_NEAR(turned.y, 1, 1e-15);
    EXPECT_EQ(turned.z, 7);
}

TEST_F(MeshOfScene, is_either_a_file_or_a_shape_of_some_detail) {
    const auto error = [&](const json& mesh) -> std::string {
        try {
            read(mesh);
            return "no error";
        } catch (const UsageError& refused) {
            return refused.what();
        }
    };
    EXPECT_EQ(error({{"material", "grey"}}),
              "scene.json: /meshes/0: found neither \"file\" nor \"shape\"; allowed: one of them");
    EXPECT_THAT(error({{"material", "grey"}, {"file", "a.obj"}, {"shape", "box"}}), HasSubstr("found both"));
    EXPECT_THAT(error({{"material", "grey"}, {"file", "a.obj"}, {"detail", 1}}),
                HasSubstr("/meshes/0/detail: "));
    EXPECT_THAT(error({{"material", "grey"}, {"shape", "box"}}), HasSubstr("\"detail\" is missing"));
    EXPECT_THAT(error({{"material", "grey"}, {"shape", "bix"}, {"detail", 1}}),
                HasSubstr("did you mean box?"));
    for (const json& detail : {json(-1), json(1.5), json("1"), json(1000000)})
        EXPECT_THAT(error({{"material", "grey"}, {"shape", "box"}, {"detail", detail}}),
                    AllOf(HasSubstr("/meshes/0/detail: found "), HasSubstr("an integer from 0 to ")));
}

}  // namespace
}  // namespace ptb
