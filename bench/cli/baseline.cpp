#include "bench/cli/baseline.h"

#include <fmt/format.h>

#include "bench/cli/judged.h"
#include "bench/cli/outputs.h"
#include "bench/cli/tell.h"
#include "bench/plan/data_dir.h"
#include "bench/record/result_file.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

fs::path baseline_file(const std::string& name, const fs::path& folder) {
    std::error_code ignored;
    for (const fs::path& file :
         {fs::path(name), folder / (name + ".json"), data_dir() / "results" / "baselines" / (name + ".json")})
        if (fs::is_regular_file(file, ignored)) return file;
    throw UsageError(fmt::format("--baseline: found \"{}\", which is no file, and {}.json is not in {}",
                                 printable(name), printable(name), folder.string()));
}

/// The file to be; its folder is made when needed.
fs::path new_baseline(const std::string& name, const fs::path& folder) {
    if (file_safe(name) != name)
        throw UsageError(fmt::format("--save-baseline: found \"{}\"; allowed: letters, digits, '.', '_', '-'",
                                     printable(name)));
    std::error_code ignored;
    fs::create_directories(folder, ignored);
    const fs::path file = folder / (name + ".json");
    check_writable("--save-baseline", file);
    return file;
}

}  // namespace

Baseline::Baseline(const RunFlags& flags) {
    if (!flags.baseline.empty()) base_ = read_session(baseline_file(flags.baseline, flags.baseline_dir));
    if (!flags.save_baseline.empty()) save_as_ = new_baseline(flags.save_baseline, flags.baseline_dir);
}

void Baseline::judge(ResultFile& result, const Config& config) {
    if (!base_ || result.run.interrupted) return;
    const Tolerances tolerances = tolerances_of({}, config);
    const CompareRules rules{[&](const SessionCase& c) { return tolerances.of(c.params.value_or(Case())); }};
    comparison_ = compare_sessions({*base_}, {session_of(result, "this run")}, rules);
    result.verdict.json = comparison_text(*comparison_);
}

void Baseline::conclude(const ResultFile& result, const CommonFlags& common, std::FILE* out,
                        Outcome& outcome) const {
    if (!save_as_.empty() && !result.run.interrupted) {
        write_result(save_as_, result);
        tell(common, fmt::format("baseline written: {}", save_as_.string()));
    }
    if (!comparison_) return;
    add_comparison(outcome, *comparison_, {});
    show_comparison(*comparison_, fmt::format("base: {}; new: this run", base_->file), {}, out);
}

}  // namespace ptb
