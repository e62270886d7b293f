#include "bench/report/history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "bench/report/changes.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

constexpr std::size_t most_in_trend = 48;
constexpr std::array heights{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr double least_trend = 0.05;  ///< of log time: smaller noise does not fill a trend's height

struct Change {
    const HistoryLine* line = nullptr;
    const Step* step = nullptr;
};

/// Slowdowns before others, each the larger first.
std::vector<Change> changes_of(const History& history) {
    std::vector<Change> all;
    for (const HistoryLine& line : history.lines)
        for (const Step& step : line.steps) all.push_back({&line, &step});
    std::stable_sort(all.begin(), all.end(), [](const Change& a, const Change& b) {
        const double x = a.step->shift.value, y = b.step->shift.value;
        return (x > 0) != (y > 0) ? x > y : std::abs(x) > std::abs(y);
    });
    return all;
}

/// "3fa2b1c0d -> 77ab01e2f", or that it is the same.
std::string kernels_text(const HistoryLine& line, const Step& step) {
    const std::string &before = line.points[step.at - 1].kernel_hash, &now = line.points[step.at].kernel_hash;
    if (before.empty() || now.empty()) return "-";
    return before == now ? "same" : fmt::format("{} -> {}", short_hash(before), short_hash(now));
}

std::string half_width_text(const HistoryPoint& point) {
    if (!point.interval_ns) return "-";
    const auto& [low, high] = *point.interval_ns;
    return fmt::format("{:.1f}", 50 * (high - low) / point.median_ns);
}

/// The newest times as bars of eight heights, by log time; a bar before each change.
std::string trend(const HistoryLine& line) {
    std::vector<double> logs;
    for (const HistoryPoint& point : line.points) logs.push_back(std::log(point.median_ns));
    const auto [low, high] = std::minmax_element(logs.begin(), logs.end());
    const double range = std::max(*high - *low, least_trend);
    std::string text;
    for (std::size_t i = logs.size() - std::min(logs.size(), most_in_trend); i < logs.size(); ++i) {
        const double share = 0.5 + (logs[i] - (*low + *high) / 2) / range;
        const auto at = std::min(heights.size() - 1, static_cast<std::size_t>(share * heights.size()));
        for (const Step& step : line.steps)
            if (step.at == i) text += "|";
        text += heights[at];
    }
    return text;
}

std::string first_to_last(const HistoryLine& line) {
    return fmt::format("{:.3f}", line.points.back().median_ns / line.points.front().median_ns);
}

std::string changes_text(const HistoryLine& line) {
    std::vector<std::string> ratios;
    for (const Step& step : line.steps)
        ratios.push_back(ratio_of_shift(step.shift.value) + (step.suspected ? "?" : ""));
    return fmt::format("{}", fmt::join(ratios, ", "));
}

bool any_apart(const History& history) {
    return std::any_of(history.lines.begin(), history.lines.end(),
                       [](const HistoryLine& line) { return !line.where.empty(); });
}

/// A column that only histories of several machines need.
void append_where(Grid& grid, const std::vector<std::string>& cells) {
    grid.columns.insert(grid.columns.begin() + 2, {"on", false, 40});
    for (std::size_t i = 0; i < cells.size(); ++i) grid.rows[i].insert(grid.rows[i].begin() + 2, cells[i]);
}

/// Kernels that lines have from this run on, as "pt 3fa2b1c0d".
std::set<std::string> new_kernels(const History& history, std::size_t run) {
    std::set<std::string> found;
    for (const HistoryLine& line : history.lines)
        for (std::size_t i = 0; i < line.points.size(); ++i) {
            const HistoryPoint& point = line.points[i];
            const bool is_new = i == 0 || line.points[i - 1].kernel_hash != point.kernel_hash;
            if (point.run == run && is_new && !point.kernel_hash.empty())
                found.insert(line.name.substr(0, line.name.find(' ')) + " " + short_hash(point.kernel_hash));
        }
    return found;
}

}  // namespace

std::string date_text(const HistoryRun& run) {
    std::string date = run.started_at.substr(0, 16);
    std::replace(date.begin(), date.end(), 'T', ' ');
    return date.empty() ? run.file : date;
}

std::string short_hash(const std::string& hash) { return hash.substr(0, 9); }

std::string state_text(const Step& step) {
    const bool slower = step.shift.value > 0;
    if (step.suspected) return slower ? "suspected slower" : "suspected faster";
    return slower ? "regressed" : "improved";
}

Section history_changes(const History& history) {
    Section section;
    const auto changes = changes_of(history);
    section.title = changes.empty() ? "no change" : fmt::format("{} changes", changes.size());
    section.grid.columns = {{"device", false, 24},  {"case", false, 0}, {"since", false, 0},
                            {"revision", false, 0}, {"run", true, 0},   {"ratio", true, 0},
                            {"95 %", true, 0},      {"p", true, 0},     {"state", false, 0},
                            {"kernel", false, 0}};
    std::vector<std::string> where;
    for (const auto& [line, step] : changes) {
        const std::size_t number = line->points[step->at].run;
        const HistoryRun& run = history.runs[number];
        section.grid.rows.push_back({line->device, line->name, date_text(run), short_hash(run.revision),
                                     std::to_string(number + 1), ratio_of_shift(step->shift.value),
                                     interval_of_shift(step->shift.interval), fmt::format("{:.2g}", step->p),
                                     state_text(*step), kernels_text(*line, *step)});
        where.push_back(line->where);
    }
    if (any_apart(history)) append_where(section.grid, where);
    if (changes.empty())
        section.notes.push_back(fmt::format("No level of {} lines over {} runs changed.",
                                            history.lines.size(), history.runs.size()));
    else
        section.notes.emplace_back(
            "ratio: time since then / time before; p: that there is such a change in any line of runs "
            "without one; suspected: the newest runs alone, too few to be sure");
    return section;
}

Section history_lines(const History& history) {
    Section section;
    section.title = fmt::format("{} lines over {} runs", history.lines.size(), history.runs.size());
    section.grid.columns = {{"device", false, 24}, {"case", false, 0},     {"runs", true, 0},
                            {"first ms", true, 0}, {"newest ms", true, 0}, {"+- %", true, 0},
                            {"ratio", true, 0},    {"changes", false, 0},  {"trend", false, 0}};
    std::vector<std::string> where;
    for (const HistoryLine& line : history.lines) {
        section.grid.rows.push_back(
            {line.device, line.name, std::to_string(line.points.size()),
             number_text(ms(line.points.front().median_ns)), number_text(ms(line.points.back().median_ns)),
             half_width_text(line.points.back()), first_to_last(line), changes_text(line), trend(line)});
        where.push_back(line.where);
    }
    if (any_apart(history)) append_where(section.grid, where);
    section.notes = {
        "+-: half the 95 % interval of the newest median; ratio: newest / first; changes: each ratio, with ? "
        "where it is only suspected",
        fmt::format("trend: the last {} runs that have a time, by its logarithm; | before a change",
                    most_in_trend)};
    return section;
}

Section history_runs(const History& history) {
    Section section;
    section.title = "the runs";
    section.grid.columns = {{"run", true, 0},
                            {"began", false, 0},
                            {"revision", false, 0},
                            {"new kernels", false, 0},
                            {"file", false, 60}};
    for (std::size_t i = 0; i < history.runs.size(); ++i) {
        const HistoryRun& run = history.runs[i];
        section.grid.rows.push_back({std::to_string(i + 1), date_text(run), short_hash(run.revision),
                                     fmt::format("{}", fmt::join(new_kernels(history, i), ", ")), run.file});
    }
    section.notes.emplace_back(
        "new kernels: by the hash of the text that the driver got, where the run before has not that");
    return section;
}

Section history_apart(const History& history) {
    Section section;
    section.title = "not comparable";
    section.grid.columns = {{"file", false, 60}, {"left out because", false, 0}};
    for (const LeftOut& each : history.left_out) section.grid.rows.push_back({each.file, each.why});
    for (const std::string& each : history.apart) section.notes.push_back("lines of their own: " + each);
    return section;
}

std::vector<Section> history_sections(const History& history) {
    std::vector<Section> all;
    if (!history.lines.empty())
        all = {history_lines(history), history_changes(history), history_runs(history)};
    const Section apart = history_apart(history);
    if (!apart.grid.rows.empty() || !apart.notes.empty()) all.push_back(apart);
    return all;
}

}  // namespace ptb
