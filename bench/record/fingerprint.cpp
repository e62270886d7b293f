#include "bench/record/fingerprint.h"

#include <set>

#include <fmt/format.h>

#include "bench/plan/tuned.h"
#include "bench/record/cpus.h"
#include "core/input/json.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr std::size_t most_shown = 60;

void add_host(RunFingerprint& facts, const ResultFile& run) {
    facts["cpu"] = fmt::format("{}, {} cores", run.host.cpu, run.host.cores);
    facts["CPUs allowed"] = std::to_string(run.host.cpus_allowed);
    facts["CPU quota"] = quota_text(run.host.cpu_quota);
}

void add_devices(RunFingerprint& facts, const ResultFile& run) {
    for (const DeviceInfo& device : run.devices) {
        if (!device.excluded.empty()) continue;
        facts["device " + device.key] =
            fmt::format("{}, {}, {} compute units", device.name, device.vendor, device.compute_units);
        facts["driver of " + device.key] =
            fmt::format("{} {}, {}", device.platform, device.platform_version, device.driver_version);
    }
}

void add_options(RunFingerprint& facts, const RunInfo& run) {
    static const std::set<std::string> not_in_a_time{"name",    "description",    "device",
                                                     "timeout", "max_total_time", "kernel_dir"};
    if (run.settings.json.empty()) return;
    const Json settings = parse_json(run.settings.json, "settings");
    for (const auto& [key, value] : settings.items())
        if (!not_in_a_time.contains(key)) facts["option " + key] = dump_json(value);
}

void add_scenes(RunFingerprint& facts, const RunInfo& run) {
    for (const std::string& scene : run.scenes) {
        const auto split = scene.rfind(' ');
        if (split != std::string::npos) facts["scene " + scene.substr(0, split)] = scene.substr(split + 1);
    }
}

void add_kernels(RunFingerprint& facts, const ResultFile& run) {
    for (const Record& record : run.cases)
        if (record.build && !record.build->kernel_hash.empty())
            facts["kernel " + record.params.kernel] = record.build->kernel_hash;
}

void add_tuned(RunFingerprint& facts, const ResultFile& run) {
    for (const Case& best : run.run.tuned)
        facts[fmt::format("tuning of {} on {}", best.kernel, best.device)] = launch_text(best);
}

std::string value_in(const RunFingerprint& facts, const std::string& name) {
    const auto found = facts.find(name);
    return found == facts.end() ? "nothing" : found->second;
}

}  // namespace

std::string scene_hash_of(const RunInfo& run, const std::string& scene) {
    for (const std::string& each : run.scenes)
        if (each.starts_with(scene + " ") && each.rfind(' ') == scene.size())
            return each.substr(scene.size() + 1);
    return {};
}

RunFingerprint asked_of(const RunInfo& run) {
    RunFingerprint facts;
    facts["ptbench"] = fmt::format("{} {}", run.tool_version, run.git_sha);
    add_options(facts, run);
    add_scenes(facts, run);
    return facts;
}

RunFingerprint fingerprint_of(const ResultFile& run) {
    RunFingerprint facts = asked_of(run.run);
    add_host(facts, run);
    add_devices(facts, run);
    add_kernels(facts, run);
    add_tuned(facts, run);
    return facts;
}

std::vector<std::string> differences(const RunFingerprint& a, const std::string& there,
                                     const RunFingerprint& b, const std::string& here) {
    RunFingerprint all = a;
    all.insert(b.begin(), b.end());
    std::vector<std::string> texts;
    for (const auto& [name, value] : all) {
        const bool both = a.contains(name) && b.contains(name);
        if (both ? a.at(name) == b.at(name) : name.starts_with("kernel ")) continue;
        const auto [one, other] = where_they_differ(value_in(a, name), value_in(b, name), most_shown);
        texts.push_back(fmt::format("{} ({} {}, {} {})", name, there, one, here, other));
    }
    return texts;
}

}  // namespace ptb
