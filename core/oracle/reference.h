#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/image/image.h"

namespace ptb {

/// A stored truth that renders are judged against: NAME.exr (layers "mean" and "variance", the variance being
/// that of one sample) with NAME.json beside it (everything else).
struct Reference {
    std::string scene, kernel;
    std::string scene_content;  ///< `scene_hash`: another scene may have the name
    Size size;
    int path_length = 0;
    int spp = 0;
    double segments_per_sample = 0;
    double segments_variance = 0;  ///< variance of one sample's segment count
    double full_length_share = 0;  ///< share of paths that reached path_length
    std::string made_by;           ///< the command that made it
    Image mean, variance;
};

/// "thesis_pt_128x128_pl128": the file name of a reference without its extension.
std::string reference_name(const std::string& scene, const std::string& kernel, Size size, int path_length);

/// Writes both files into `folder`. Throws ImageError.
void save_reference(const std::filesystem::path& folder, const Reference& reference);

/// Reads a reference, or nothing when there is none of that name and of a scene of this content
/// (`Scene::content`). Throws ImageError when it is broken.
std::optional<Reference> load_reference(const std::filesystem::path& folder, const std::string& name,
                                        const std::string& scene_content);

}  // namespace ptb
