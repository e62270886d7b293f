#include <algorithm>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "core/input/json.h"
#include "core/input/nearest.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

/// Names of the configs in a folder, sorted.
std::vector<std::string> config_names(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

bool is_file(const fs::path& file) {
    std::error_code error;
    return fs::exists(file, error) && !fs::is_directory(file, error);
}

/// What lies beside a config is meant; what does not stays a path from here.
std::string beside(const fs::path& config, const std::string& path) {
    const fs::path there = config.parent_path() / path;
    std::error_code error;
    return fs::exists(there, error) ? there.lexically_normal().string() : path;
}

/// Replaces the values of an axis.
void replace_values(Axis& axis, const std::string& name,
                    const std::function<std::string(const std::string&)>& replaced) {
    for (std::size_t i = 0; i < axis.names.size(); ++i)
        for (auto& point : axis.points)
            if (axis.names[i] == name) point.at(i) = replaced(point.at(i));
}

}  // namespace

void move_paths(Config& config, const fs::path& config_folder,
                const std::function<std::string(const std::string&)>& moved) {
    const auto moved_scene = [&](const std::string& scene) {
        std::error_code error;
        const bool ships = fs::exists(config_folder / "scenes" / (scene + ".json"), error);
        return ships || fs::path(scene).is_absolute() ? scene : moved(scene);
    };
    for (Series& series : config.series)
        for (Axis& axis : series.axes) replace_values(axis, "scene", moved_scene);
    std::string& kernels = config.measure.kernel_dir;
    if (!kernels.empty() && fs::path(kernels).is_relative()) kernels = moved(kernels);
}

Config load_config(const std::string& name_or_file, const fs::path& config_folder) {
    const auto names = config_names(config_folder);
    const bool named = std::find(names.begin(), names.end(), name_or_file) != names.end();
    const fs::path file = named ? config_folder / (name_or_file + ".json") : fs::path(name_or_file);
    if (!named && !is_file(file))
        throw UsageError(
            fmt::format("config: found \"{}\", which is no file{}; allowed: a file, or one of: {}",
                        printable(name_or_file), did_you_mean(name_or_file, names), fmt::join(names, ", ")));
    Config config = parse_config(read_text(file), file.string());
    move_paths(config, config_folder, [&](const std::string& path) { return beside(file, path); });
    return config;
}

}  // namespace ptb
