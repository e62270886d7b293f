// Meshes of scene files: what is taken, where it is put, and what is refused.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/input/usage_error.h"
#include "core/mesh/geometry.h"
#include "core/mesh/transform.h"
#include "core/scene/content.h"
#include "core/scene/scene.h"
#include "core/source/text_hash.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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

/// Of a mesh of the scene, or "no error".
std::string error_of(const std::function<void()>& read) {
    try {
        read();
    } catch (const UsageError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        EXPECT_LT(std::string(error.what()).size(), 600U);
        return error.what();
    }
    return "no error";
}

TEST_F(MeshOfScene, is_either_a_file_or_a_shape_of_some_detail) {
    const auto error = [&](const json& mesh) { return error_of([&] { read(mesh); }); };
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

std::string ply(const std::string& encoding, int vertices, int faces, const std::string& body) {
    return "ply\nformat " + encoding + " 1.0\ncomment a test\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

template <class... Values>
std::string bytes_of(Values... values) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
    return bytes;
}

std::string binary_corners() { return bytes_of(0.f, 0.f, 0.f, 4.f, 0.f, 0.f, 0.f, 3.f, 0.f); }

std::string binary_ply() {
    return ply("binary_little_endian", 3, 1, binary_corners() + bytes_of(std::uint8_t{3}, 0, 1, 2));
}

std::string binary_stl() {
    return std::string(80, ' ') + bytes_of(1u, 0.f, 0.f, 1.f) + binary_corners() + bytes_of(std::uint16_t{0});
}

const std::string ascii_stl =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex 0 3 "
    "0\nendloop\nendfacet\nendsolid s\n";

/// The triangle as glTF whose buffer is beside it, moved by its node and turned about z by the node's parent.
json gltf() {
    return {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {1}}}}},
            {"nodes",
             {{{"mesh", 0}, {"translation", {1, 0, 0}}},
              {{"children", {0}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
            {"accessors",
             {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
              {{"bufferView", 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}}},
            {"bufferViews",
             {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 36}},
              {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 6}}}},
            {"buffers", {{{"byteLength", 42}, {"uri", "one.bin"}}}}};
}

std::string buffer() {
    return binary_corners() + bytes_of(std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2});
}

std::string glb_of(const json& document, const std::string& bin) {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto size = [](const std::string& part) { return static_cast<std::uint32_t>(part.size()); };
    const std::string chunks =
        bytes_of(size(text)) + "JSON" + text + bytes_of(size(bin)) + std::string("BIN\0", 4) + bin;
    return "glTF" + bytes_of(2u, 12 + size(chunks)) + chunks;
}

/// With its buffer in it.
std::string glb(json document, const std::string& bin) {
    document["buffers"][0].erase("uri");
    return glb_of(document, bin);
}

const std::vector<Vec3> corners = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};

TEST_F(MeshOfScene, is_the_same_of_every_format) {
    for (const auto& [name, text] : {std::pair<std::string, std::string>("one.obj", obj_triangle),
                                     {"text.ply", ply("ascii", 3, 1, "0 0 0\n4 0 0\n0 3 0\n3 0 1 2\n")},
                                     {"binary.ply", binary_ply()},
                                     {"TEXT.STL", ascii_stl},
                                     {"binary.stl", binary_stl()}}) {
        const Mesh mesh = read_file(name, text);
        EXPECT_EQ(mesh.vertices, corners) << name;
        EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}})) << name;
    }
}

TEST_F(MeshOfScene, of_gltf_stands_where_its_nodes_put_it) {
    std::ofstream(folder_ / "one.bin", std::ios::binary) << buffer();
    for (const auto& [name, text] : {std::pair<std::string, std::string>("one.gltf", gltf().dump()),
                                     {"one.glb", glb(gltf(), buffer() + "  ")}}) {
        const Mesh mesh = read_file(name, text);
        ASSERT_EQ(mesh.vertices.size(), 3U) << name;
        const std::vector<Vec3> expected = {{0, 1, 0}, {0, 5, 0}, {-3, 1, 0}};
        for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(length(mesh.vertices[i] - expected[i]), 1e-6) << name;
    }
}

TEST_F(MeshOfScene, of_gltf_may_have_its_buffer_in_its_folder_or_below_and_nowhere_else) {
    fs::create_directories(folder_ / "a b" / "part");
    for (const char* file : {"one.bin", "a b/c%d.bin", "a b/part/e..bin"})
        std::ofstream(folder_ / file, std::ios::binary) << buffer();
    const auto read_from = [&](const std::string& uri) {
        json document = gltf();
        document["buffers"][0]["uri"] = uri;
        return error_of([&] { read_file("a b/some.gltf", document.dump()); });
    };
    for (const char* uri : {"c%25d.bin", "part/e..bin", "./part/e%2E.bin", "%63%25d.bin"})
        EXPECT_EQ(read_from(uri), "no error") << uri;
    const std::string absolute = (folder_ / "one.bin").string();
    for (const std::string& uri :
         {std::string("../one.bin"), std::string("part/../../one.bin"), std::string("%2e%2E/one.bin"),
          absolute, "%2F" + absolute.substr(1), "file://" + absolute, std::string("c%d.bin"),
          std::string("a+b"), std::string("part")})
        EXPECT_THAT(read_from(uri), HasSubstr("/buffers/0/uri: found")) << uri;
    for (const char* uri : {"c%2", "c%", "c%x5d.bin", "c%00.bin"})
        EXPECT_THAT(read_from(uri), HasSubstr("allowed: two hexadecimal digits, not 00, after each %"));
}

TEST_F(MeshOfScene, of_polygons_is_cut_into_triangles_and_has_no_points_and_lines) {
    const Mesh mesh = read_file("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\np 3\n");
    EXPECT_EQ(mesh.faces.size(), 2U);
    EXPECT_EQ(mesh.vertices.size(), 4U);
    EXPECT_EQ(mesh.dropped, (Dropped{0, 2}));
    const Mesh arrow = read_file("arrow.obj", "v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nf 1 2 3 4\n");
    double total = 0;
    for (const Face& face : arrow.faces)
        total += area(arrow.vertices[face[0]], arrow.vertices[face[1]], arrow.vertices[face[2]]);
    EXPECT_DOUBLE_EQ(total, 1) << "it is not convex";
}

TEST_F(MeshOfScene, has_no_triangles_without_area_and_counts_them) {
    const std::string text =
        "v 0 0 0\nv 4 0 0\nv 0 3 0\nv 2 0 0\nv 0 -0 0\nf 1 2 3\nf 1 4 2\nf 1 1 2\nf 1 5 3\n";
    const Mesh mesh = read_file("some.obj", text);
    EXPECT_EQ(mesh.faces.size(), 1U);
    EXPECT_EQ(mesh.dropped, (Dropped{3, 0}));
    EXPECT_EQ(error_of([&] { read_file("none.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"); }),
              "scene.json: /meshes/0: none.obj: found 1 triangles, none of which has an area; allowed: at "
              "least one");
}

TEST_F(MeshOfScene, that_is_bad_is_refused_in_one_line_that_says_why) {
    struct Bad {
        std::string name, text, why;
    };
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", rows = "0 0 0\n1 0 0\n0 1 0\n";
    json no_nodes = gltf();
    no_nodes["scenes"][0]["nodes"] = json::array();
    for (const Bad& bad : std::initializer_list<Bad>{
             {"a.obj", "", "cannot read FILE: "},
             {"b.obj", vertices, "cannot read FILE: it has no faces"},
             {"c.obj", vertices + "l 1 2\n", "it has no faces"},
             {"d.obj", vertices + "f 1 2 4\n", "index"},
             {"e.obj", vertices + "f 1 2 -4\n", "index"},
             {"f.obj", "v 0 nan 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "face 0 has a vertex that is not finite"},
             {"g.obj", "v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not finite"},
             {"h.obj", std::string("\x00\x01\xff\x7f noise", 10), "it is no text"},
             {"i.fbx", "text", "\".fbx\" is no format of meshes; allowed: .obj, .ply, .stl, .gltf, .glb"},
             {"j", "text", "\"\" is no format"},
             {"k.ply", "text", "it does not begin with \"ply\""},
             {"l.ply", "ply\nformat ascii 1.0\n", "no \"end_header\""},
             {"m.ply", ply("ascii", 3, 1, rows + "3 0 1 3\n"), "face 0 has vertex 3, and there are 3"},
             {"n.ply", ply("ascii", 3, 1, rows + "3 0 1 -1\n"), "face 0 has vertex 4294967295"},
             {"o.ply", ply("ascii", 3, 1, rows), "it ends before the last of 1 of \"face\""},
             {"o2.ply", ply("ascii", 3, 1, rows + "3 0 1\n"), "row 0 of \"face\" is not as its header says"},
             {"o3.ply", ply("ascii", 3, 1, "0 0 0\n1 0 0\n0 1 x\n3 0 1 2\n"), "row 2 of \"vertex\""},
             {"p.ply", ply("ascii", 2000000000, 1, rows), "says that it has 2000000000 of \"vertex\""},
             {"q.ply", ply("binary", 3, 1, rows), "its format is \"binary\"; allowed: ascii"},
             {"r.ply", ply("binary_little_endian", 3, 1, binary_corners()), "the last of 1 of \"face\""},
             {"s.ply",
              ply("binary_little_endian", 3, 1, binary_corners() + bytes_of(std::uint8_t{255}, 0, 1, 2)),
              "\"face\""},
             {"t.stl", "text", "it has 4 bytes"},
             {"u.stl", ascii_stl.substr(0, 60), "it ends before \"endsolid\""},
             {"v.stl", binary_stl() + "x",
              "it has 135 bytes; an STL file of the 1 triangles that it says has 134"},
             {"w.gltf", "{}", "\"asset\" is missing"},
             {"x.gltf", gltf().dump(),
              "/buffers/0/uri: found \"one.bin\"; allowed: a file in this one's folder or below, or data in "
              "base64"},
             {"y.glb", glb(gltf(), "short"), "/buffers/0/byteLength: found 42; allowed: at most the 5 bytes"},
             {"z.glb", glb(no_nodes, buffer()), "it has no faces"},
         }) {
        const std::string file = (folder_ / bad.name).string();
        std::string expected = bad.why;
        if (const auto at = expected.find("FILE"); at != std::string::npos) expected.replace(at, 4, file);
        EXPECT_THAT(
            error_of([&] { read_file(bad.name, bad.text); }),
            AllOf(StartsWith("scene.json: /meshes/0/file: cannot read " + file), HasSubstr(expected)));
    }
    fs::create_directory(folder_ / "folder.obj");
    EXPECT_THAT(error_of([&] {
                    read({{"file", "folder.obj"}, {"material", "grey"}});
                }),
                HasSubstr("it is a folder"));
    EXPECT_THAT(error_of([&] {
                    read({{"file", "gone.obj"}, {"material", "grey"}});
                }),
                HasSubstr("gone.obj: No such file or directory"));
    EXPECT_THAT(error_of([&] {
                    read({{"file", "/dev/zero"}, {"material", "grey"}});
                }),
                HasSubstr("no regular file"));
}

TEST_F(MeshOfScene, of_gltf_whose_parts_do_not_fit_together_is_refused) {
    const auto error = [&](const std::string& pointer, const json& value) {
        json document = gltf();
        document[json::json_pointer(pointer)] = value;
        return error_of([&] { read_file("bad.glb", glb(document, buffer())); });
    };
    for (const auto& [pointer, value] :
         std::vector<std::pair<std::string, json>>{{"/accessors/0/count", 4},
                                                   {"/accessors/0/bufferView", 2},
                                                   {"/accessors/0/type", "VEC9"},
                                                   {"/accessors/1/byteOffset", 2},
                                                   {"/accessors/0/componentType", 5124},
                                                   {"/accessors/0/sparse", json::object()},
                                                   {"/bufferViews/0/byteLength", 43},
                                                   {"/bufferViews/1/byteOffset", 37},
                                                   {"/bufferViews/0/buffer", 1},
                                                   {"/bufferViews/0/byteStride", 20},
                                                   {"/nodes/0/mesh", 1},
                                                   {"/nodes/0/children", {1}},
                                                   {"/nodes/1/children", {7}},
                                                   {"/nodes/1/children", {0, 0}},
                                                   {"/nodes/0/matrix", {1, 2}},
                                                   {"/scenes/0/nodes", {9}},
                                                   {"/scene", 1},
                                                   {"/meshes/0/primitives/0/mode", 7},
                                                   {"/meshes/0/primitives/0/indices", 0},
                                                   {"/meshes/0/primitives/0/attributes/POSITION", 1},
                                                   {"/asset/version", "1.0"},
                                                   {"/extensionsRequired", {"KHR_draco_mesh_compression"}}})
        EXPECT_THAT(error(pointer, value), AllOf(StartsWith("scene.json: /meshes/0/file: cannot read "),
                                                 HasSubstr("/"), HasSubstr("allowed: ")))
            << pointer;
    EXPECT_EQ(error("/images", {{{"uri", "picture.png"}}}), "no error") << "pictures are not looked at";
    EXPECT_THAT(error("/nodes/1/children", {1}), HasSubstr("below itself")) << "a node is its own child";
}

TEST_F(MeshOfScene, of_a_file_cut_off_anywhere_is_read_or_refused) {
    // OBJ has no end: what is cut off there is not missed.
    for (const auto& [name, text] : {std::pair<std::string, std::string>("a.obj", obj_triangle),
                                     {"b.ply", ply("ascii", 3, 1, "0 0 0\n4 0 0\n0 3 0\n3 0 1 2\n")},
                                     {"c.ply", binary_ply()},
                                     {"d.stl", ascii_stl},
                                     {"e.stl", binary_stl()},
                                     {"f.glb", glb(gltf(), buffer())}})
        for (std::size_t size = 0; size + 1 < text.size(); size += 3) {
            const std::string error =
                error_of([&, &file = name, &whole = text] { read_file(file, whole.substr(0, size)); });
            EXPECT_TRUE(error != "no error" || name == "a.obj" ||
                        (name == "d.stl" && size > text.size() - 4) ||
                        (name == "b.ply" && size > text.size() - 2))
                << name << " of " << size << " bytes";
        }
}

/// A tetrahedron wound outwards.
const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";

TEST_F(MeshOfScene, of_glass_has_to_be_closed_and_wound_outwards) {
    const auto error = [&](const std::string& text) {
        return error_of([&] { read_file("glass.obj", text, "glass"); });
    };
    EXPECT_EQ(error(tetrahedron + "f 2 3 4\n"), "no error");
    EXPECT_EQ(
        error(tetrahedron),
        "scene.json: /meshes/0: the mesh is open, or wound against itself, at the edge (0, 1, 0) - (1, 0, "
        "0), which "
        "1 faces pass one way and 0 the other; allowed: a dielectric that is closed and wound outwards");
    EXPECT_THAT(error(tetrahedron + "f 2 4 3\n"), HasSubstr("which 2 faces pass one way and 0 the other"));
    EXPECT_THAT(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"),
                HasSubstr("the mesh is inside out"));
    EXPECT_THAT(error(obj_triangle + "f 3 2 1\n"), HasSubstr("the mesh is flat"));
    EXPECT_EQ(error("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nv 1 0 0\nv 0 1 0\nv 0 0 "
                    "1\nf 5 6 7\n"),
              "no error")
        << "vertices in the same place are one";
    EXPECT_EQ(error_of([&] { read_file("matte.obj", tetrahedron); }), "no error") << "others may be open";
}

TEST_F(MeshOfScene, keeps_a_scene_within_its_number_of_triangles) {
    const auto error = [&](const json& meshes) {
        json scene = json::parse(text_of(meshes.at(0)));
        scene["meshes"] = meshes;
        return error_of(
            [&] { parse_scene(scene.dump(), "scene.json", {.folder = folder_, .most_triangles = 60}); });
    };
    const json box = {{"shape", "box"}, {"detail", 1}, {"material", "grey"}};
    const json small_box = {{"shape", "box"}, {"detail", 0}, {"material", "grey"}};
    std::ofstream(folder_ / "one.obj") << obj_triangle;
    EXPECT_EQ(error({box, small_box}), "no error") << "48 + 12";
    EXPECT_EQ(error({box, box}), "scene.json: /meshes/1/detail: found 1; allowed: an integer from 0 to 0");
    EXPECT_EQ(error({box, small_box, small_box}),
              "scene.json: /meshes/2: box has at least 12 triangles; allowed: 0");
    EXPECT_THAT(error({box, small_box, {{"file", "one.obj"}, {"material", "grey"}}}),
                HasSubstr("it has 1 triangles; allowed: 0"));
}

TEST_F(MeshOfScene, too_far_away_for_single_precision_is_refused) {
    EXPECT_THAT(error_of([&] {
                    read({{"shape", "box"},
                          {"detail", 0},
                          {"material", "grey"},
                          {"transform", {{"scale", 1e18}, {"translate", {1e18, 0, 0}}}}});
                }),
                HasSubstr("/meshes/0: a vertex is at (2e+18, "));
}

TEST_F(MeshOfScene, tells_of_a_file_before_and_while_it_is_read) {
    std::ofstream(folder_ / "one.obj") << obj_triangle;
    std::vector<double> shares;
    MeshReading reading{folder_};
    reading.on_file = [&](const std::string& name, std::uint64_t memory_bytes, double done) {
        EXPECT_EQ(name, "one.obj");
        EXPECT_GE(memory_bytes, obj_triangle.size());
        shares.push_back(done);
    };
    parse_scene(text_of({{"file", "one.obj"}, {"material", "grey"}}), "scene.json", reading);
    ASSERT_GE(shares.size(), 2U);
    EXPECT_EQ(shares.front(), 0);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_LE(shares.back(), 1);
}

TEST_F(MeshOfScene, is_part_of_what_identifies_the_scene) {
    const auto write = [&](const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    };
    const auto hash_with = [&](const json& mesh) {
        write("scene.json", text_of(mesh));
        return scene_hash(folder_ / "scene.json");
    };
    const json of_file = {{"file", "one.obj"}, {"material", "grey"}},
               of_gltf = {{"file", "one.gltf"}, {"material", "grey"}};
    write("one.obj", obj_triangle);
    const std::string before = hash_with(of_file);
    EXPECT_EQ(hash_with(of_file), before);
    write("one.obj", obj_triangle + "# more\n");
    EXPECT_NE(hash_with(of_file), before);
    write("one.gltf", gltf().dump());
    write("one.bin", buffer());
    const std::string with_buffer = hash_with(of_gltf);
    write("one.bin", buffer() + " ");
    EXPECT_NE(hash_with(of_gltf), with_buffer) << "vertices may lie beside the file";
    const json of_glb = {{"file", "one.glb"}, {"material", "grey"}};
    write("one.glb", glb_of(gltf(), ""));
    const std::string of_one = hash_with(of_glb);
    write("one.bin", buffer());
    EXPECT_NE(hash_with(of_glb), of_one) << "of GLB as well";
    const json of_shape = {{"shape", "box"}, {"detail", 0}, {"material", "grey"}};
    EXPECT_EQ(hash_with(of_shape), text_hash(text_of(of_shape))) << "the text says all";
    fs::remove(folder_ / "one.obj");
    EXPECT_THAT(error_of([&] { hash_with(of_file); }), HasSubstr("cannot read "));
}

TEST_F(MeshOfScene, is_told_where_something_of_it_is_left_out) {
    std::ofstream(folder_ / "some.obj") << obj_triangle << "f 1 1 2\nl 1 2\np 1\n";
    std::ofstream(folder_ / "one.obj") << obj_triangle;
    const auto told = [&](const std::string& name) {
        return left_out_of(
            parse_scene(text_of({{"file", name}, {"material", "grey"}}), "scene.json", {.folder = folder_}));
    };
    EXPECT_EQ(told("some.obj"), std::vector<std::string>{
                                    "some.obj: left out 1 triangle without an area and 2 points and lines"});
    EXPECT_EQ(told("one.obj"), std::vector<std::string>{});
}

}  // namespace
}  // namespace ptb
