#include "bench/cli/check.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "bench/plan/data_dir.h"
#include "bench/plan/nearest.h"
#include "bench/plan/usage_error.h"
#include "bench/record/printable.h"
#include "core/integrator/registry.h"
#include "core/scene/scene.h"

namespace ptb {
namespace {

void check_kernel(const std::string& kernel) {
    std::vector<std::string> known;
    for (const auto& integrator : integrators()) known.push_back(std::string(integrator.id));
    if (std::find(known.begin(), known.end(), kernel) != known.end()) return;
    throw UsageError(fmt::format("kernel: found \"{}\"{}; allowed: {}", printable(kernel),
                                 did_you_mean(kernel, known), fmt::join(known, ", ")));
}

void check_scene(const std::string& scene) {
    try {
        load_scene(scene_file(scene));
    } catch (const SceneError& error) {
        throw UsageError(error.what());
    }
}

}  // namespace

std::filesystem::path scene_file(const std::string& name_or_file) {
    const auto names = scene_names();
    if (std::find(names.begin(), names.end(), name_or_file) != names.end()) {
        return data_dir() / "configs" / "scenes" / (name_or_file + ".json");
    }
    if (std::filesystem::is_regular_file(name_or_file)) return name_or_file;
    throw UsageError(fmt::format("scene: found \"{}\", which is no file{}; allowed: a file, or one of: {}",
                                 printable(name_or_file), did_you_mean(name_or_file, names),
                                 fmt::join(names, ", ")));
}

void check_names(const std::vector<Case>& cases) {
    std::set<std::string> kernels, scenes;
    for (const Case& c : cases) {
        kernels.insert(c.kernel);
        scenes.insert(c.scene);
    }
    for (const auto& kernel : kernels) check_kernel(kernel);
    for (const auto& scene : scenes) check_scene(scene);
}

}  // namespace ptb
