#include "bench/cli/check.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include <fmt/format.h>

#include "bench/cli/tell.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "core/input/nearest.h"
#include "core/input/printable.h"
#include "core/input/usage_error.h"
#include "core/integrator/registry.h"
#include "core/scene/content.h"
#include "core/scene/scene.h"

namespace ptb {
namespace {

void check_kernel(const std::string& kernel) {
    const std::vector<std::string> known = integrator_ids();
    if (std::find(known.begin(), known.end(), kernel) != known.end()) return;
    throw UsageError(fmt::format("kernel: found \"{}\"{}; allowed: {}", printable(kernel),
                                 did_you_mean(kernel, known), fmt::join(known, ", ")));
}

constexpr std::uint64_t large_bytes = std::uint64_t{256} << 20;

/// Says which files are read that take long, and on a terminal what is done of them.
class LargeFiles {
  public:
    explicit LargeFiles(const CommonFlags& flags) : flags_(flags) {}
    void show(const std::string& name, std::uint64_t memory_bytes, double done) const {
        if (memory_bytes < large_bytes) return;
        if (done == 0)
            tell(flags_, fmt::format("reading {}, which takes up to {} MiB of memory", printable(name),
                                     memory_bytes >> 20));
        if (!flags_.quiet && is_live(stderr))
            put(stderr, done < 1 ? fmt::format("\r{:3.0f} %", 100 * done) : "\r\033[K");
    }

  private:
    const CommonFlags& flags_;
};

/// What is left out of a scene.
std::vector<std::string> check_scene(const std::string& scene, const CommonFlags& flags) {
    const std::filesystem::path file = scene_file(scene, data_dir());
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        const auto names = scene_names();
        throw UsageError(
            fmt::format("scene: found \"{}\", which is no file{}; allowed: a file, or one of: {}",
                        printable(scene), did_you_mean(scene, names), fmt::join(names, ", ")));
    }
    const LargeFiles large(flags);
    MeshReading reading;
    reading.on_file = [&](const std::string& name, std::uint64_t memory_bytes, double done) {
        large.show(name, memory_bytes, done);
    };
    std::vector<std::string> remarks;
    for (const std::string& line : left_out_of(load_scene(file, reading)))
        remarks.push_back(fmt::format("scene {}: {}", scene, line));
    return remarks;
}

}  // namespace

void refuse_several_devices(const std::vector<Case>& cases, const std::string& command) {
    for (const Case& c : cases)
        if (const std::string axis = of_several_devices(c); !axis.empty())
            throw UsageError(fmt::format(
                "{}: {} measures one device at a time; allowed: devices 1, together no", axis, command));
}

std::vector<std::string> check_names(const std::vector<Case>& cases, const CommonFlags& flags) {
    std::set<std::string> kernels, scenes;
    for (const Case& c : cases) {
        kernels.insert(c.kernel);
        scenes.insert(c.scene);
    }
    for (const auto& kernel : kernels) check_kernel(kernel);
    std::vector<std::string> remarks;
    for (const auto& scene : scenes) {
        const auto of_scene = check_scene(scene, flags);
        remarks.insert(remarks.end(), of_scene.begin(), of_scene.end());
    }
    return remarks;
}

void check_names_and_tell(const std::vector<Case>& cases, const CommonFlags& flags) {
    for (const std::string& remark : check_names(cases, flags)) tell(flags, "warning: " + remark);
}

}  // namespace ptb
