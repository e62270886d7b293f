#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace ptb {

/// The file of a scene: a name among DATA/configs/scenes, or else a path as it stands.
inline std::filesystem::path scene_file(const std::string& name_or_file,
                                        const std::filesystem::path& data_folder) {
    const std::filesystem::path shipped = data_folder / "configs" / "scenes" / (name_or_file + ".json");
    std::error_code ignored;
    return std::filesystem::exists(shipped, ignored) ? shipped : std::filesystem::path(name_or_file);
}

}  // namespace ptb
