#include "bench/cli/history.h"

#include <fmt/format.h>

#include "bench/cli/exit_code.h"
#include "bench/cli/formats.h"
#include "bench/cli/judged.h"
#include "bench/cli/tell.h"
#include "bench/compare/history.h"
#include "bench/report/history.h"
#include "bench/report/html/page.h"

namespace ptb {
namespace {

Destinations history_destinations(const ReportFlags& flags) {
    const bool for_one_run = !flags.csv.empty() || !flags.csv_samples.empty() || !flags.format.empty();
    if (!flags.files.empty() || for_one_run)
        throw UsageError("report --history FOLDER: allowed beside it: --html, --md, --json, --tolerance");
    Destinations asked = asked_for({{"html", flags.html}, {"md", flags.md}, {"json", flags.json}});
    check_asked(asked);
    refuse_shared_files(asked);
    return asked;
}

template <class Render>
std::string joined(const History& history, Render render) {
    std::vector<std::string> texts;
    for (const Section& section : history_sections(history)) texts.push_back(render(section));
    return fmt::format("{}", fmt::join(texts, "\n"));
}

std::string text_in(const std::string& format, const History& history) {
    if (format == "html") return history_page(history);
    return format == "md" ? joined(history, to_markdown) : history_text(history);
}

History history_in(const ReportFlags& flags) {
    JudgeFlags judge;
    judge.tolerance = flags.tolerance;
    const double tolerance = tolerances_of(judge, Config()).of(Case());
    HistoryFolder read = read_history(flags.history);
    History history = history_of(std::move(read.sessions), [&](const SessionCase&) { return tolerance; });
    history.left_out = std::move(read.left_out);
    return history;
}

}  // namespace

int report_history(const Options& options) {
    const ReportFlags& flags = options.report;
    const Destinations asked = history_destinations(flags);
    const History history = history_in(flags);
    for (const LeftOut& each : history.left_out)
        put(stderr, fmt::format("left out: {}: {}\n", each.file, each.why));
    if (history.lines.empty())
        throw UsageError(fmt::format("--history: {}: no file with a time in it", flags.history));
    for (const auto& [format, destination] : asked) write_to(destination, text_in(format, history));
    if (asked.empty()) {
        const TextStyle style = text_style(options.common, stdout);
        put(stdout, joined(history, [&](const Section& section) { return to_text(section, style); }));
    }
    return exit_codes::done;
}

}  // namespace ptb
