#include "bench/cli/resume.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include <fmt/format.h>

#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "bench/record/fingerprint.h"
#include "bench/record/host.h"
#include "bench/record/journal.h"
#include "bench/record/result_file.h"
#include "core/input/json.h"
#include "core/integrator/registry.h"
#include "core/source/source.h"

namespace ptb {
namespace {

std::map<Case, Record> by_case(const std::vector<Record>& records) {
    std::map<Case, Record> found;
    for (const Record& record : records) found.try_emplace(record.params, record);
    return found;
}

std::vector<Record> tried(const std::vector<Record>& records) {
    std::vector<Record> kept;
    std::copy_if(records.begin(), records.end(), std::back_inserter(kept),
                 [](const Record& record) { return record.status != Status::skipped; });
    return kept;
}

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

RunFingerprint fingerprint_with_kernels(const ResultFile& now, const std::vector<Case>& planned,
                                        const std::string& kernel_dir) {
    RunFingerprint facts = fingerprint_of(now);
    std::set<std::string> kernels;
    for (const Case& c : planned) kernels.insert(c.kernel);
    for (const auto& kernel : kernels)
        facts["kernel " + kernel] = kernel_source(integrator(kernel).file(), kernel_dir).hash;
    return facts;
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

std::optional<ResultFile> earlier_run(const RunFlags& flags) {
    if (flags.resume.empty()) return std::nullopt;
    ResultFile run = read_run(flags.resume);
    std::error_code unknown;
    see_from(std::filesystem::current_path(unknown), run, data_dir());
    return run;
}

Config config_of(const ResultFile& earlier, const std::string& file) {
    if (earlier.run.settings.json.empty())
        throw UsageError(fmt::format("--resume: {} does not say what was asked for (/run/settings)", file));
    return parse_config(earlier.run.settings.json, file + ": /run/settings");
}

void go_on(ResultFile& now, const ResultFile& earlier, const std::vector<Case>& planned,
           const RunFlags& flags, const std::string& kernel_dir) {
    auto changes = differences(fingerprint_of(earlier), "there",
                               fingerprint_with_kernels(now, planned, kernel_dir), "here");
    const std::vector<Record> kept = tried(earlier.cases);
    if (in_plan_order(planned, kept).size() != kept.size())
        changes.emplace_back("plan (records there of no case here, or two of one)");
    if (!changes.empty())
        throw NotComparable(
            fmt::format("--resume: {} is of another run: {}", flags.resume, fmt::join(changes, "; ")));
    const RunInfo began = now.run;
    now.run = earlier.run;
    now.run.resumed_at.push_back(began.started_at);
    for (const std::string& warning : earlier.warnings)
        if (std::find(now.warnings.begin(), now.warnings.end(), warning) == now.warnings.end())
            now.warnings.push_back(warning);
    now.cases = in_plan_order(planned, kept);
}

std::vector<Case> missing(const std::vector<Case>& planned, const std::vector<Record>& records) {
    const auto there = by_case(records);
    std::vector<Case> cases;
    std::copy_if(planned.begin(), planned.end(), std::back_inserter(cases),
                 [&](const Case& c) { return !there.contains(c); });
    return cases;
}

std::vector<Record> in_plan_order(const std::vector<Case>& planned, const std::vector<Record>& records) {
    const auto there = by_case(records);
    std::vector<Record> ordered;
    for (const Case& c : planned)
        if (const auto found = there.find(c); found != there.end()) ordered.push_back(found->second);
    return ordered;
}

}  // namespace ptb
