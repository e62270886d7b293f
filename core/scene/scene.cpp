#include "core/scene/scene.h"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/input/json.h"
#include "core/input/nearest.h"
#include "core/scene/content.h"
#include "core/scene/mesh_entries.h"
#include "core/scene/node.h"

namespace ptb {
namespace {

using namespace scene_json;

constexpr double tiny = std::numeric_limits<double>::min();

const Range radius_range = {1e-18, largest, "a finite number > 0 (from 1e-18 to 1e18)"};
const Range share_range = {0, 1, "a share of light in [0, 1]"};
const Range radiance_range = {0, largest, "a finite number >= 0, at most 1e18"};
const Range ior_range = {0.01, 100, "an index of refraction in [0.01, 100]"};
const Range fov_range = {tiny, std::nextafter(180.0, 0.0), "an angle between 0 and 180 degrees"};

/// A name also becomes part of file names, hence the few letters.
std::string read_name(const Node& node) {
    const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    const std::string rule = "1 to 64 letters, digits, '_', '-' or '.', the first one no '-' or '.'";
    const std::string name = node.text(rule);
    if (name.empty() || name.size() > 64 || letters.find(name[0]) == std::string::npos ||
        name.find_first_not_of(letters + "-.") != std::string::npos)
        node.refuse(rule);
    return name;
}

Camera read_camera(const Node& node) {
    allow_only(node.json, node.where, {"position", "look_at", "up", "fov_deg"});
    const Camera camera = {
        read_vec3(node.at("position"), coordinate_range), read_vec3(node.at("look_at"), coordinate_range),
        read_vec3(node.at("up"), coordinate_range), read_number(node.at("fov_deg"), fov_range)};
    const Vec3 view = camera.look_at - camera.position;
    if (length(view) == 0) node.at("look_at").refuse("another point than the camera's position");
    if (length(camera.up) == 0) node.at("up").refuse("a direction that is not zero");
    if (length(cross(normalized(view), normalized(camera.up))) < 1e-6)
        node.at("up").refuse("a direction that is not parallel to the view");
    return camera;
}

Material read_matte(const Node& node) {
    allow_only(node.json, node.where, {"type", "albedo"});
    Material material;
    material.albedo = read_vec3(node.at("albedo"), share_range);
    return material;
}

Material read_mirror(const Node& node) {
    allow_only(node.json, node.where, {"type", "reflectance"});
    Material material;
    material.reflectance = read_vec3(node.at("reflectance"), share_range);
    return material;
}

Material read_dielectric(const Node& node) {
    allow_only(node.json, node.where, {"type", "ior"});
    Material material;
    material.ior = read_number(node.at("ior"), ior_range);
    return material;
}

Material read_emitter(const Node& node) {
    allow_only(node.json, node.where, {"type", "radiance", "albedo"});
    Material material;
    material.radiance = read_vec3(node.at("radiance"), radiance_range);
    material.scatters = node.json.contains("albedo");
    if (material.scatters) material.albedo = read_vec3(node.at("albedo"), share_range);
    return material;
}

struct MaterialReader {
    MaterialType type;
    std::string word;
    Material (*read)(const Node&);
};

const std::vector<MaterialReader> material_readers = {
    {MaterialType::matte, "matte", read_matte},
    {MaterialType::mirror, "mirror", read_mirror},
    {MaterialType::dielectric, "dielectric", read_dielectric},
    {MaterialType::emitter, "emitter", read_emitter},
};

Material read_material(const std::string& name, const Node& node) {
    std::vector<std::string> words;
    for (const MaterialReader& reader : material_readers) words.push_back(reader.word);
    const std::string rule = fmt::format("one of {}", fmt::join(words, ", "));
    const Node type = node.at("type");
    const std::string word = type.text(rule);
    for (const MaterialReader& reader : material_readers) {
        if (reader.word != word) continue;
        Material material = reader.read(node);
        material.name = name;
        material.type = reader.type;
        return material;
    }
    type.refuse(rule + did_you_mean(word, words));
}

std::vector<Material> read_materials(const Node& node) {
    std::vector<Material> materials;
    if (!node.json.is_object()) node.refuse("an object of materials by name");
    for (const auto& [name, value] : node.json.items())
        materials.push_back(read_material(name, {value, Where(node.where, name)}));
    return materials;
}

/// Refuses spheres in the same place where it would matter which of them a path meets first.
class Twins {
  public:
    explicit Twins(const MaterialIndex& materials) : materials_(materials) {}

    void add(const Sphere& sphere, std::size_t number, const Where& where) {
        const Vec3& c = sphere.centre;
        const auto [first, is_new] =
            seen_.emplace(std::tuple(c.x, c.y, c.z, sphere.radius), Seen{number, sphere.material});
        if (is_new || (first->second.material == sphere.material && !matters(sphere))) return;
        where.fail(fmt::format(
            "spheres {} and {} are the same; allowed: twice the same of one material, matte or mirror",
            first->second.number, number));
    }

  private:
    struct Seen {
        std::size_t number;
        int material;
    };
    /// Light is asked of emitters by their number, and glass changes sides.
    bool matters(const Sphere& sphere) const {
        const MaterialType type = materials_[sphere.material].type;
        return type == MaterialType::dielectric || type == MaterialType::emitter;
    }

    const MaterialIndex& materials_;
    std::map<std::tuple<double, double, double, double>, Seen> seen_;
};

std::vector<Sphere> read_spheres(const Node& node, const MaterialIndex& materials) {
    std::vector<Sphere> spheres;
    if (!node.json.is_array()) node.refuse("a list of spheres");
    Twins twins(materials);
    for (std::size_t i = 0; i < node.json.size(); ++i) {
        const Node sphere = node.at(i);
        allow_only(sphere.json, sphere.where, {"centre", "radius", "material"});
        spheres.push_back({read_vec3(sphere.at("centre"), coordinate_range),
                           read_number(sphere.at("radius"), radius_range),
                           materials.read(sphere.at("material"))});
        twins.add(spheres.back(), i, sphere.where);
    }
    return spheres;
}

}  // namespace

std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.faces.size();
    return count;
}

Scene parse_scene(std::string_view json_text, const std::string& origin, const MeshReading& reading) {
    const Json json = parse_json(json_text, origin);
    const Node root{json, Where(origin)};
    allow_only(json, root.where, {"name", "camera", "materials", "spheres", "meshes"});
    Scene scene;
    scene.name = read_name(root.at("name"));
    scene.camera = read_camera(root.at("camera"));
    scene.materials = read_materials(root.at("materials"));
    const MaterialIndex materials(scene.materials);
    scene.spheres = read_spheres(root.at("spheres"), materials);
    if (root.has("meshes")) scene.meshes = read_meshes(root.at("meshes"), materials, reading);
    if (scene.spheres.empty() && scene.meshes.empty())
        root.at("spheres").refuse("a list of at least one sphere, or else \"meshes\"");
    return scene;
}

Scene load_scene(const std::filesystem::path& file, MeshReading reading) {
    reading.folder = file.parent_path();
    Scene scene = parse_scene(read_text(file), file.string(), reading);
    scene.content = scene_hash(file);
    return scene;
}

}  // namespace ptb
