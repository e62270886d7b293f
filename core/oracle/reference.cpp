#include "core/oracle/reference.h"

#include <bit>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/image/image_io.h"

namespace ptb {
namespace {

/// Cuts a number to 12 significant bits: far finer than a variance is known, and the file packs better. Zero
/// stays zero, and nothing else becomes zero.
float coarse(float value) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & 0xfffff000U); }

Image coarse(Image image) {
    for (float& value : image.rgb) value = coarse(value);
    return image;
}

nlohmann::ordered_json facts(const Reference& reference) {
    return {{"scene", reference.scene},
            {"scene_hash", reference.scene_content},
            {"kernel", reference.kernel},
            {"width", reference.size.width},
            {"height", reference.size.height},
            {"path_length", reference.path_length},
            {"spp", reference.spp},
            {"segments_per_sample", reference.segments_per_sample},
            {"segments_variance", reference.segments_variance},
            {"full_length_share", reference.full_length_share},
            {"made_by", reference.made_by}};
}

Reference from_facts(const nlohmann::json& json) {
    Reference reference;
    json.at("scene").get_to(reference.scene);
    json.at("scene_hash").get_to(reference.scene_content);
    json.at("kernel").get_to(reference.kernel);
    json.at("width").get_to(reference.size.width);
    json.at("height").get_to(reference.size.height);
    json.at("path_length").get_to(reference.path_length);
    json.at("spp").get_to(reference.spp);
    json.at("segments_per_sample").get_to(reference.segments_per_sample);
    json.at("segments_variance").get_to(reference.segments_variance);
    json.at("full_length_share").get_to(reference.full_length_share);
    json.at("made_by").get_to(reference.made_by);
    return reference;
}

Reference read_facts(const std::filesystem::path& file) {
    try {
        std::ifstream stream(file);
        Reference reference = from_facts(nlohmann::json::parse(stream));
        if (reference.spp > 0 && reference.path_length > 0) return reference;
    } catch (const nlohmann::json::exception& error) {
        throw ImageError(fmt::format("{}: cannot be read: {}", file.string(), error.what()));
    }
    throw ImageError(file.string() + ": a reference has at least one sample per pixel and one segment");
}

Image take_layer(std::map<std::string, Image>& layers, const std::string& name, Size size,
                 const std::filesystem::path& file) {
    const auto found = layers.find(name);
    if (found == layers.end() || found->second.size != size)
        throw ImageError(fmt::format("{}: there is no layer \"{}\" of {} x {} pixels", file.string(), name,
                                     size.width, size.height));
    return std::move(found->second);
}

}  // namespace

std::string reference_name(const std::string& scene, const std::string& kernel, Size size, int path_length) {
    return fmt::format("{}_{}_{}x{}_pl{}", scene, kernel, size.width, size.height, path_length);
}

void save_reference(const std::filesystem::path& folder, const Reference& reference) {
    const std::string name =
        reference_name(reference.scene, reference.kernel, reference.size, reference.path_length);
    write_exr_layers(folder / (name + ".exr"),
                     {{"mean", reference.mean}, {"variance", coarse(reference.variance)}});
    write_bytes(folder / (name + ".json"), facts(reference).dump(4) + "\n");
}

std::optional<Reference> load_reference(const std::filesystem::path& folder, const std::string& name,
                                        const std::string& scene_content) {
    const std::filesystem::path json = folder / (name + ".json"), exr = folder / (name + ".exr");
    if (!std::filesystem::exists(json) && !std::filesystem::exists(exr)) return std::nullopt;
    Reference reference = read_facts(json);
    if (reference.scene_content != scene_content) return std::nullopt;
    std::map<std::string, Image> layers = read_exr_layers(exr);
    reference.mean = take_layer(layers, "mean", reference.size, exr);
    reference.variance = take_layer(layers, "variance", reference.size, exr);
    return reference;
}

}  // namespace ptb
