#include "core/scene/content.h"

#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/input/json.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"
#include "core/mesh/mesh_file.h"
#include "core/source/text_hash.h"

namespace ptb {
namespace {

/// In blocks, since the largest do not fit in memory.
std::string hash_of_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || !std::filesystem::is_regular_file(file))
        throw UsageError(fmt::format("cannot read {}", printable(file.string())));
    std::string hashes, block(1 << 20, '\0');
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0)
        hashes += text_hash(std::string_view(block).substr(0, static_cast<std::size_t>(stream.gcount())));
    return text_hash(hashes);
}

/// Files that a scene names, where it names them as it should.
std::vector<std::string> names_of_files(const Json& scene) {
    std::vector<std::string> names;
    if (!scene.is_object() || !scene.contains("meshes") || !scene["meshes"].is_array()) return names;
    for (const Json& mesh : scene["meshes"])
        if (mesh.is_object() && mesh.contains("file") && mesh["file"].is_string())
            names.push_back(mesh["file"].get<std::string>());
    return names;
}

std::string counted(std::uint64_t count, const std::string& one, const std::string& many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::string scene_hash(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    const std::string hash = text_hash(text);
    std::string with_meshes = hash;
    for (const std::string& name : names_of_files(parse_json(text, file.string())))
        for (const auto& part : files_of_mesh(file.parent_path() / name)) with_meshes += hash_of_file(part);
    return with_meshes == hash ? hash : text_hash(with_meshes);
}

std::vector<std::string> left_out_of(const Scene& scene) {
    std::vector<std::string> lines;
    for (const Mesh& mesh : scene.meshes) {
        std::vector<std::string> parts;
        if (const auto count = mesh.dropped.triangles; count > 0)
            parts.push_back(counted(count, "triangle", "triangles") + " without an area");
        if (const auto count = mesh.dropped.points_and_lines; count > 0)
            parts.push_back(counted(count, "point or line", "points and lines"));
        if (!parts.empty())
            lines.push_back(fmt::format("{}: left out {}", printable(mesh.name), fmt::join(parts, " and ")));
    }
    return lines;
}

}  // namespace ptb
