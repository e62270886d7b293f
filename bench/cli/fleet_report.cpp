#include "bench/cli/fleet_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/cli/formats.h"
#include "bench/cli/tell.h"
#include "bench/fleet/judged.h"
#include "bench/fleet/merge.h"
#include "bench/report/fleet.h"

namespace ptb {
namespace {

bool has_wrong_bits(const Judged& judged) {
    return std::any_of(judged.classes.begin(), judged.classes.end(),
                       [](const JudgedClass& each) { return !each.wrong.empty(); });
}

Outcome outcome_of(const Judged& judged) {
    Outcome outcome;
    for (const auto& [card, status] : judged.failed)
        (status == Status::invalid ? outcome.wrong_image : outcome.failed) = true;
    outcome.wrong_image |= has_wrong_bits(judged);
    outcome.coverage_lost = !judged.missing.empty();
    for (const Suspect& suspect : judged.suspects) outcome.regressed |= judged.is_slow(suspect.card);
    return outcome;
}

std::string text_in(const std::string& format, const Judged& judged, const std::string& folder) {
    if (format == "html") return fleet_page(judged, folder);
    return format == "md" ? fleet_markdown(judged, folder) : fleet_csv(judged);
}

Destinations destinations(const ReportFlags& flags, const FleetFolder& folder) {
    if (!flags.format.empty() || !flags.json.empty() || !flags.csv_samples.empty())
        throw UsageError(
            fmt::format("report: of a fleet there are --html, --md and --csv; any other format is that "
                        "of its result file: ptbench report {}",
                        folder.result().string()));
    const Destinations asked = asked_for({{"html", flags.html}, {"md", flags.md}, {"csv", flags.csv}});
    check_asked(asked);
    refuse_shared_files(asked);
    return asked;
}

}  // namespace

Outcome show_fleet(const Options& options, const FleetFolder& folder) {
    const Judged found = judged(folder, merge(folder));
    put(stdout, fleet_text(found, folder.path.string(), text_style(options.common, stdout)));
    return outcome_of(found);
}

int fleet_report(const Options& options, const FleetFolder& folder) {
    const Destinations asked = destinations(options.report, folder);
    if (asked.empty()) return exit_code(show_fleet(options, folder));
    const Judged found = judged(folder, merge(folder));
    for (const auto& [format, destination] : asked)
        write_to(destination, text_in(format, found, folder.path.string()));
    return exit_code(outcome_of(found));
}

}  // namespace ptb
