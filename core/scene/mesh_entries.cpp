#include "core/scene/mesh_entries.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/input/nearest.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"
#include "core/mesh/mesh_file.h"
#include "core/mesh/shapes/shapes.h"
#include "core/mesh/transform.h"

namespace ptb {
namespace {

using namespace scene_json;

const Range scale_range = {1e-18, largest, "a finite number > 0 (from 1e-18 to 1e18)"};
const Range angle_range = {-1e6, 1e6, "an angle of at most 1e6 degrees"};

Transform read_transform(const Node& node) {
    allow_only(node.json, node.where, {"scale", "rotate_deg", "translate"});
    Transform transform;
    if (node.has("scale")) transform.scale = read_number(node.at("scale"), scale_range);
    if (node.has("rotate_deg")) transform.rotate_deg = read_vec3(node.at("rotate_deg"), angle_range);
    if (node.has("translate")) transform.translate = read_vec3(node.at("translate"), coordinate_range);
    return transform;
}

/// A mesh before it comes into the world.
struct Source {
    std::string name;
    MeshFile mesh;
};

std::string shape_names() {
    std::vector<std::string> names;
    for (const Shape& shape : shapes()) names.push_back(shape.name);
    return fmt::format("one of {}", fmt::join(names, ", "));
}

const Shape& shape_of(const Node& node) {
    std::vector<std::string> names;
    const std::string name = node.text(shape_names());
    for (const Shape& shape : shapes()) {
        if (shape.name == name) return shape;
        names.push_back(shape.name);
    }
    node.refuse(shape_names() + did_you_mean(name, names));
}

Source read_shape(const Node& entry, std::uint64_t most_triangles) {
    const Shape& shape = shape_of(entry.at("shape"));
    const int most = shape.most_detail(most_triangles);
    if (most < 0)
        entry.where.fail(fmt::format("{} has at least {} triangles; allowed: {}", shape.name,
                                     shape.triangles(0), most_triangles));
    const auto detail = static_cast<int>(entry.at("detail").integer(0, static_cast<std::uint64_t>(most)));
    return {fmt::format("{} {}", shape.name, detail), {shape.make(detail), 0}};
}

Source read_file(const Node& entry, const MeshReading& reading, std::uint64_t most_triangles) {
    const Node node = entry.at("file");
    const std::string name = node.text("the path of a mesh's file");
    const std::filesystem::path file = reading.folder / name;
    MeshFileOptions options{most_triangles};
    if (reading.on_file) {
        const std::uint64_t memory = mesh_file_memory(file);
        reading.on_file(name, memory, 0);
        options.on_progress = [=, &reading](double done) { reading.on_file(name, memory, done); };
    }
    try {
        return {name, read_mesh_file(file, options)};
    } catch (const UsageError& error) {
        node.where.fail(error.what());
    }
}

std::string text_of(const Vec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z); }

/// A path inside of a dielectric must meet a face to leave it.
void check_dielectric(const Geometry& geometry, const Where& where) {
    const std::string allowed = "; allowed: a dielectric that is closed and wound outwards";
    if (const auto edge = loose_edge(geometry))
        where.fail(
            fmt::format("the mesh is open, or wound against itself, at the edge {} - {}, which {} faces pass "
                        "one way and {} the other{}",
                        text_of(edge->from), text_of(edge->to), edge->forwards, edge->backwards, allowed));
    if (const double volume = signed_volume(geometry); !(volume > 0))
        where.fail(fmt::format("the mesh is {}{}", volume < 0 ? "inside out" : "flat", allowed));
}

/// In the world, without faces that have no area.
void place(const Geometry& geometry, const Transform& transform, const Where& where, Mesh& mesh) {
    const Placing placed(transform);
    for (const Vec3& vertex : geometry.vertices()) mesh.vertices.push_back(placed(vertex));
    for (const Vec3& v : mesh.vertices)
        if (!(largest_coordinate(v) <= largest))
            where.fail(fmt::format("a vertex is at {}; allowed: {}", text_of(v), coordinate_range.text));
    for (const Face& face : geometry.faces()) {
        const bool has_area =
            area(mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]) > 0;
        if (has_area) mesh.faces.push_back(face);
    }
    mesh.dropped.triangles = geometry.faces().size() - mesh.faces.size();
}

Mesh read_mesh(const Node& entry, const MaterialIndex& materials, const MeshReading& reading,
               std::uint64_t most_triangles) {
    allow_only(entry.json, entry.where, {"file", "shape", "detail", "material", "transform"});
    if (entry.has("file") && entry.has("shape"))
        entry.where.fail("found both \"file\" and \"shape\"; allowed: one of them");
    if (!entry.has("file") && !entry.has("shape"))
        entry.where.fail("found neither \"file\" nor \"shape\"; allowed: one of them");
    if (entry.has("file") && entry.has("detail"))
        entry.at("detail").where.fail("found it beside \"file\"; allowed: beside \"shape\"");
    Mesh mesh;
    mesh.material = materials.read(entry.at("material"));
    Transform transform;
    if (entry.has("transform")) transform = read_transform(entry.at("transform"));
    const Source source =
        entry.has("file") ? read_file(entry, reading, most_triangles) : read_shape(entry, most_triangles);
    mesh.name = source.name;
    mesh.dropped.points_and_lines = source.mesh.points_and_lines;
    if (materials[mesh.material].type == MaterialType::dielectric)
        check_dielectric(source.mesh.geometry, entry.where);
    place(source.mesh.geometry, transform, entry.where, mesh);
    if (mesh.faces.empty())
        entry.where.fail(
            fmt::format("{}: found {} triangles, none of which has an area; allowed: at least one",
                        printable(mesh.name), mesh.dropped.triangles));
    return mesh;
}

}  // namespace

std::vector<Mesh> read_meshes(const Node& list, const MaterialIndex& materials, const MeshReading& reading) {
    if (!list.json.is_array()) list.refuse("a list of meshes");
    std::vector<Mesh> meshes;
    std::uint64_t left = reading.most_triangles;
    for (std::size_t i = 0; i < list.json.size(); ++i) {
        meshes.push_back(read_mesh(list.at(i), materials, reading, left));
        left -= meshes.back().faces.size();
    }
    return meshes;
}

}  // namespace ptb
