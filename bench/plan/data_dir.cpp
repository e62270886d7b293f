#include "bench/plan/data_dir.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "core/input/usage_error.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> json_files(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

fs::path self_path() { return fs::read_symlink("/proc/self/exe"); }

fs::path data_dir() {
    const char* const variable = std::getenv("PTBENCH_DATA_DIR");
    const bool given = variable != nullptr && *variable != '\0';
    const fs::path folder =
        given ? fs::path(variable) : (self_path().parent_path() / "../share/ptbench").lexically_normal();
    std::error_code ignored;
    if (fs::is_directory(folder / "configs", ignored)) return folder;
    throw UsageError(fmt::format("{} has no configs/; set PTBENCH_DATA_DIR to ptbench's data folder{}",
                                 folder.string(), given ? " (it is set, but wrong)" : ""));
}

std::vector<std::string> scene_names() { return json_files(data_dir() / "configs" / "scenes"); }

std::vector<std::string> config_names() { return json_files(data_dir() / "configs"); }

}  // namespace ptb
