#include "bench/cli/tuned.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "bench/cli/tell.h"
#include "bench/tune/store.h"
#include "core/input/printable.h"
#include "core/integrator/registry.h"
#include "core/source/source.h"

namespace ptb {
namespace {

/// Kernels of a plan, with the hashes of their texts; a text that is not whole has none, and nothing was
/// tuned for it.
std::map<std::string, std::string> kernel_hashes(const Config& config) {
    std::map<std::string, std::string> hashes;
    for (const Case& c : expand(config, {DeviceInfo()})) hashes[c.kernel];
    for (auto& [kernel, hash] : hashes) try {
            hash = kernel_source(integrator(kernel).file(), config.measure.kernel_dir).hash;
        } catch (const SourceError&) {
        }
    return hashes;
}

}  // namespace

std::filesystem::path tune_file(const RunFlags& flags) {
    return flags.tune_file.empty() ? default_tune_file() : std::filesystem::path(flags.tune_file);
}

std::vector<Case> stored_launches(const Options& options, const Config& config,
                                  const std::vector<DeviceInfo>& devices) {
    std::vector<Case> launches;
    if (options.run.no_tuned) return launches;
    const auto stored = read_tuned(tune_file(options.run));
    if (stored.empty()) return launches;
    for (const auto& [kernel, hash] : kernel_hashes(config))
        for (const DeviceInfo& device : devices) {
            const TunedLookup lookup = look_up(stored, device, kernel, hash);
            if (lookup.found) launches.push_back(lookup.found->best);
            if (!lookup.stale.empty())
                tell(options.common,
                     printable(fmt::format(
                         "not used: {} on {} was {}; `ptbench tune -d {} --kernel {}` tunes again", kernel,
                         device.key, lookup.stale, device.key, kernel)));
        }
    return launches;
}

std::vector<Case> used_launches(const std::vector<Case>& tuned, const std::vector<Case>& planned) {
    std::vector<Case> used;
    std::copy_if(tuned.begin(), tuned.end(), std::back_inserter(used), [&](const Case& best) {
        return std::any_of(planned.begin(), planned.end(), [&](const Case& c) {
            return c.device == best.device && c.kernel == best.kernel &&
                   (c.lanes_tuned || c.work_group_tuned);
        });
    });
    return used;
}

}  // namespace ptb
