#include "bench/cli/check.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include <fmt/format.h>

#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "core/input/nearest.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"
#include "core/integrator/registry.h"
#include "core/scene/scene.h"

namespace ptb {
namespace {

void check_kernel(const std::string& kernel) {
    const std::vector<std::string> known = integrator_ids();
    if (std::find(known.begin(), known.end(), kernel) != known.end()) return;
    throw UsageError(fmt::format("kernel: found \"{}\"{}; allowed: {}", printable(kernel),
                                 did_you_mean(kernel, known), fmt::join(known, ", ")));
}

void check_scene(const std::string& scene) {
    const std::filesystem::path file = scene_file(scene, data_dir());
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        const auto names = scene_names();
        throw UsageError(
            fmt::format("scene: found \"{}\", which is no file{}; allowed: a file, or one of: {}",
                        printable(scene), did_you_mean(scene, names), fmt::join(names, ", ")));
    }
    load_scene(file);
}

}  // namespace

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
