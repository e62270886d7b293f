#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/fleet_report.h"
#include "bench/cli/formats.h"
#include "bench/cli/history.h"
#include "bench/cli/option_parts.h"
#include "bench/cli/tell.h"
#include "bench/plan/data_dir.h"
#include "bench/record/journal.h"
#include "bench/report/formats/formats.h"
#include "bench/report/table.h"

namespace ptb {
namespace {

std::string formats_help() {
    std::vector<std::string> lines;
    for (const Format& format : formats())
        lines.push_back(fmt::format("{} ({})", format.name, format.reader));
    return fmt::format("what another tool reads, to stdout: {}", fmt::join(lines, "; "));
}

Destinations destinations(const ReportFlags& flags) {
    Destinations asked = asked_for({{"html", flags.html},
                                    {"md", flags.md},
                                    {"csv", flags.csv},
                                    {"csv-samples", flags.csv_samples},
                                    {"json", flags.json}});
    if (!flags.format.empty()) asked.emplace_back(format_named(flags.format).name, to_stdout);
    check_asked(asked);
    refuse_shared_files(asked);
    return asked;
}

}  // namespace

void add_report_flags(CLI::App& app, ReportFlags& flags) {
    app.add_option("files", flags.files,
                   "result files or journals, of which several make one page; or the folder of a fleet");
    app.add_option("--format", flags.format, formats_help());
    app.add_option("--html", flags.html, "write a page here (- for stdout)");
    app.add_option("--md", flags.md, "write Markdown here (- for stdout)");
    app.add_option("--csv", flags.csv, "write CSV here (- for stdout)");
    app.add_option("--csv-samples", flags.csv_samples, "write every sample as CSV here (- for stdout)");
    app.add_option("--json", flags.json, "write the result file, or the history, here (- for stdout)");
    app.add_option("--history", flags.history,
                   "a folder of result files: a line a case over the dates of its runs, changes marked");
    app.add_option("--tolerance", flags.tolerance,
                   "of a history: changes under half of it are not told [5%]");
}

int report_command(const Options& options) {
    const ReportFlags& flags = options.report;
    if (!flags.history.empty()) return report_history(options);
    if (flags.files.empty())
        throw UsageError("report: a result file is missing, e.g. ptbench report result.json");
    if (flags.files.size() == 1 && is_fleet(flags.files.front()))
        return fleet_report(options, {flags.files.front()});
    const Destinations asked = destinations(flags);
    std::vector<StoredRun> runs;
    const std::vector<std::filesystem::path> files(flags.files.begin(), flags.files.end());
    const auto names = names_of(files);
    for (std::size_t i = 0; i < files.size(); ++i)
        runs.push_back({read_run(files[i]), files[i].parent_path(), names[i]});
    const PublishedTable published = read_published(data_dir() / "results" / "thesis-2016.json");
    std::vector<std::string> texts;
    for (const auto& [format, destination] : asked) texts.push_back(text_in(format, runs, published));
    for (std::size_t i = 0; i < asked.size(); ++i) write_to(asked[i].second, texts[i]);
    if (asked.empty())
        for (const StoredRun& run : runs)
            put(stdout, table(run.result, published, text_style(options.common, stdout)));
    return exit_codes::done;
}

}  // namespace ptb
