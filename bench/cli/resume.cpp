#include "bench/cli/resume.h"

#include <fmt/format.h>

#include "bench/plan/data_dir.h"
#include "bench/record/journal.h"
#include "bench/record/seen_from.h"

namespace ptb {

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

}  // namespace ptb
