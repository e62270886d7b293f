#include "core/scene/scene.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "core/scene/json_node.h"
#include "core/scene/json_text.h"
#include "core/scene/nearest.h"

namespace ptb {
namespace {

// The largest length, so that its square still fits the devices' single precision.
constexpr double largest = 1e18;
constexpr double tiny = std::numeric_limits<double>::min();

const Range coordinate_range = {-largest, largest, "a coordinate is a finite number, at most 1e18 from zero"};
const Range radius_range = {1e-18, largest, "a radius is a finite number > 0 (from 1e-18 to 1e18)"};
const Range share_range = {0, 1, "a share of reflected light lies in [0, 1]"};
const Range radiance_range = {0, largest, "a radiance is a finite number >= 0, at most 1e18"};
const Range ior_range = {0.01, 100, "an index of refraction lies in [0.01, 100]"};
const Range fov_range = {tiny, std::nextafter(180.0, 0.0), "a field of view lies between 0 and 180 degrees"};

/// A name also becomes part of file names, hence the few letters.
std::string read_name(const JsonNode& node) {
    const std::string letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    const std::string rule =
        "a name is 1 to 64 letters, digits, '_', '-' or '.', the first one no '-' or '.'";
    const std::string name = node.text(rule);
    if (name.empty() || name.size() > 64 || letters.find(name[0]) == std::string::npos ||
        name.find_first_not_of(letters + "-.") != std::string::npos)
        node.refuse(rule);
    return name;
}

Camera read_camera(const JsonNode& node) {
    node.allow_only({"position", "look_at", "up", "fov_deg"}, "a camera");
    const Camera camera = {node.at("position").vec3(coordinate_range),
                           node.at("look_at").vec3(coordinate_range), node.at("up").vec3(coordinate_range),
                           node.at("fov_deg").number(fov_range)};
    const Vec3 view = camera.look_at - camera.position;
    if (length(view) == 0) node.at("look_at").refuse("a camera looks at another point than its position");
    if (length(camera.up) == 0) node.at("up").refuse("an up direction is not zero");
    if (length(cross(normalized(view), normalized(camera.up))) < 1e-6)
        node.at("up").refuse("an up direction is not parallel to the view");
    return camera;
}

Material read_matte(const JsonNode& node) {
    node.allow_only({"type", "albedo"}, "a matte material");
    Material material;
    material.albedo = node.at("albedo").vec3(share_range);
    return material;
}

Material read_mirror(const JsonNode& node) {
    node.allow_only({"type", "reflectance"}, "a mirror");
    Material material;
    material.reflectance = node.at("reflectance").vec3(share_range);
    return material;
}

Material read_dielectric(const JsonNode& node) {
    node.allow_only({"type", "ior"}, "a dielectric");
    Material material;
    material.ior = node.at("ior").number(ior_range);
    return material;
}

Material read_emitter(const JsonNode& node) {
    node.allow_only({"type", "radiance", "albedo"}, "an emitter");
    Material material;
    material.radiance = node.at("radiance").vec3(radiance_range);
    material.scatters = node.has("albedo");
    if (material.scatters) material.albedo = node.at("albedo").vec3(share_range);
    return material;
}

struct MaterialReader {
    MaterialType type;
    std::string word;
    Material (*read)(const JsonNode&);
};

const std::vector<MaterialReader> material_readers = {
    {MaterialType::matte, "matte", read_matte},
    {MaterialType::mirror, "mirror", read_mirror},
    {MaterialType::dielectric, "dielectric", read_dielectric},
    {MaterialType::emitter, "emitter", read_emitter},
};

Material read_material(const std::string& name, const JsonNode& node) {
    std::vector<std::string> words;
    for (const MaterialReader& reader : material_readers) words.push_back(reader.word);
    const std::string rule = "a material's type is one of " + joined(words);
    const JsonNode type = node.at("type");
    const std::string word = type.text(rule);
    for (const MaterialReader& reader : material_readers) {
        if (reader.word != word) continue;
        Material material = reader.read(node);
        material.name = name;
        material.type = reader.type;
        return material;
    }
    type.refuse(fmt::format("{} (nearest: {})", rule, nearest_word(word, words)));
}

std::vector<Material> read_materials(const JsonNode& node) {
    std::vector<Material> materials;
    for (const std::string& name : node.keys()) materials.push_back(read_material(name, node.at(name)));
    return materials;
}

int material_index(const JsonNode& node, const std::vector<Material>& materials) {
    const std::string name = node.text("here stands the name of a material");
    std::vector<std::string> names;
    for (const Material& material : materials) names.push_back(material.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) node.refuse("the defined materials are " + shown(names, 500));
    return static_cast<int>(found - names.begin());
}

Sphere read_sphere(const JsonNode& node, const std::vector<Material>& materials) {
    node.allow_only({"centre", "radius", "material"}, "a sphere");
    return {node.at("centre").vec3(coordinate_range), node.at("radius").number(radius_range),
            material_index(node.at("material"), materials)};
}

std::vector<Sphere> read_spheres(const JsonNode& node, const std::vector<Material>& materials) {
    std::vector<Sphere> spheres;
    for (const JsonNode& element : node.elements()) spheres.push_back(read_sphere(element, materials));
    if (spheres.empty()) node.refuse("a scene has at least one sphere");
    return spheres;
}

}  // namespace

Scene parse_scene(std::string_view json_text, const std::string& origin) {
    const nlohmann::json json = parse_scene_json(json_text, origin);
    const JsonNode root(json, origin);
    root.allow_only({"name", "camera", "materials", "spheres"}, "a scene");
    Scene scene;
    scene.name = read_name(root.at("name"));
    scene.camera = read_camera(root.at("camera"));
    scene.materials = read_materials(root.at("materials"));
    scene.spheres = read_spheres(root.at("spheres"), scene.materials);
    return scene;
}

Scene load_scene(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        throw SceneError(fmt::format("{}: cannot be read: it is a folder", file.string()));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || !(text << stream.rdbuf()))
        throw SceneError(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    return parse_scene(text.str(), file.string());
}

}  // namespace ptb
