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

}  // namespace

Config load_config(const std::string& name_or_file, const fs::path& config_folder) {
    const auto names = config_names(config_folder);
    const bool named = std::find(names.begin(), names.end(), name_or_file) != names.end();
    const fs::path file = named ? config_folder / (name_or_file + ".json") : fs::path(name_or_file);
    if (!named && !is_file(file))
        throw UsageError(
            fmt::format("config: found \"{}\", which is no file{}; allowed: a file, or one of: {}",
                        printable(name_or_file), did_you_mean(name_or_file, names), fmt::join(names, ", ")));
    Config config = parse_config(read_text(file), file.string());
    return config;
}

}  // namespace ptb
