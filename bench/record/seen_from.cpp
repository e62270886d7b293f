#include "bench/record/seen_from.h"

#include <algorithm>
#include <functional>

#include "bench/plan/config.h"
#include "bench/plan/scene_file.h"

namespace ptb {
namespace {

using Renamed = std::function<std::string(const std::string&)>;

void rename_settings(JsonText& settings, const std::filesystem::path& data, const Renamed& renamed) {
    if (settings.json.empty()) return;
    Config config = parse_config(settings.json, "/run/settings");
    move_paths(config, data / "configs", renamed);
    settings.json = dump_config(config);
}

/// In the records, and in the list of hashes.
void rename_scenes(ResultFile& run, const std::filesystem::path& data, const Renamed& renamed) {
    const auto name = [&](const std::string& scene) {
        const std::filesystem::path file = scene_file(scene, data);
        return file.is_absolute() || file != scene ? scene : renamed(scene);
    };
    for (Record& record : run.cases) record.params.scene = name(record.params.scene);
    for (std::string& scene : run.run.scenes) {
        const auto split = std::min(scene.rfind(' '), scene.size());
        scene = name(scene.substr(0, split)) + scene.substr(split);
    }
}

}  // namespace

void see_from(const std::filesystem::path& here, ResultFile& run, const std::filesystem::path& data) {
    const std::filesystem::path there = run.run.folder;
    if (there.empty() || there == here) return;
    const Renamed renamed = [&](const std::string& path) {
        return (there / path).lexically_normal().lexically_proximate(here).string();
    };
    run.run.folder = here.string();
    rename_settings(run.run.settings, data, renamed);
    rename_scenes(run, data, renamed);
}

}  // namespace ptb
