#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/history.h"
#include "bench/report/html/frame.h"
#include "bench/report/html/html.h"
#include "bench/report/html/packed.h"
#include "bench/report/html/page.h"

namespace ptb {
namespace {

/// The drawing of a line: times by their logarithm, so that equal ratios are equally high.
constexpr double trend_width = 240, trend_height = 48, trend_margin = 4;
constexpr double least_trend_range = 0.05;
constexpr std::size_t most_sentences = 3;

/// Where runs and times are in a line's drawing.
class TrendScale {
  public:
    TrendScale(const HistoryLine& line, std::size_t runs) : runs_(runs) {
        low_ = high_ = std::log(line.points.front().median_ns);
        for (const HistoryPoint& point : line.points) {
            low_ = std::min(low_, std::log(point.interval_ns ? point.interval_ns->low : point.median_ns));
            high_ = std::max(high_, std::log(point.interval_ns ? point.interval_ns->high : point.median_ns));
        }
        const double middle = (low_ + high_) / 2, half = std::max(high_ - low_, least_trend_range) / 2;
        low_ = middle - half;
        high_ = middle + half;
    }
    double x(double run) const {
        return trend_margin + (trend_width - 2 * trend_margin) * (run + 0.5) / static_cast<double>(runs_);
    }
    double y(double ns) const {
        return trend_margin + (trend_height - 2 * trend_margin) * (high_ - std::log(ns)) / (high_ - low_);
    }

  private:
    std::size_t runs_;
    double low_ = 0, high_ = 0;
};

std::string vertical(const char* css_class, double x, double from, double to) {
    return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                       css_class, x, x, from, to);
}

std::string drawn_point(const HistoryPoint& point, const TrendScale& scale) {
    const double x = scale.x(static_cast<double>(point.run));
    const std::string interval = point.interval_ns ? vertical("interval", x, scale.y(point.interval_ns->high),
                                                              scale.y(point.interval_ns->low))
                                                   : "";
    return interval + fmt::format("<circle class=\"ratio\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.6\"/>", x,
                                  scale.y(point.median_ns));
}

/// Between the runs that it separates.
std::string drawn_step(const HistoryLine& line, const Step& step, const TrendScale& scale) {
    const double run = static_cast<double>(line.points[step.at].run) - 0.5;
    const char* const way = step.shift.value > 0 ? "step slower" : "step faster";
    return vertical(way, scale.x(run), 0, trend_height);
}

std::string drawn(const HistoryLine& line, std::size_t runs) {
    const TrendScale scale(line, runs);
    std::string marks;
    for (const Step& step : line.steps) marks += drawn_step(line, step, scale);
    for (const HistoryPoint& point : line.points) marks += drawn_point(point, scale);
    return fmt::format("<svg class=\"trend\" viewBox=\"0 0 {} {}\" aria-hidden=\"true\">{}</svg>",
                       trend_width, trend_height, marks);
}

/// The column of bars of text gives way to drawings.
std::string lines_table(const History& history) {
    Section section = history_lines(history);
    TableExtras extras{"sortable", {}, section.grid.columns.back().title, {}, 0};
    section.grid.columns.pop_back();
    for (auto& row : section.grid.rows) row.pop_back();
    for (const HistoryLine& line : history.lines) extras.cells.push_back(drawn(line, history.runs.size()));
    return html_table(section.grid, section.title, extras) +
           "<p>Trends: the medians and their 95 % intervals over all runs, by the logarithm of time; a line "
           "before a "
           "change.</p>\n" +
           html_paragraphs({section.notes.front()});
}

std::string sentence(const History& history, const HistoryLine& line, const Step& step) {
    const HistoryRun& run = history.runs[line.points[step.at].run];
    return fmt::format("{}: {} on {} takes {:.3f} times as long since {}{}.", state_text(step), line.name,
                       line.device, std::exp(step.shift.value), date_text(run),
                       run.revision.empty() ? "" : ", revision " + short_hash(run.revision));
}

/// What the newest level of each line is, the gravest first.
std::vector<std::string> newest_levels(const History& history) {
    std::vector<std::pair<double, std::string>> found;
    for (const HistoryLine& line : history.lines)
        if (!line.steps.empty())
            found.emplace_back(-line.steps.back().shift.value, sentence(history, line, line.steps.back()));
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> sentences;
    for (const auto& [shift, text] : found)
        if (sentences.size() < most_sentences) sentences.push_back(text);
    if (found.size() > sentences.size())
        sentences.push_back(fmt::format("And {} more, in the table.", found.size() - sentences.size()));
    if (found.empty()) return history_changes(history).notes;
    return sentences;
}

std::string table_of(const Section& section) {
    return section.grid.rows.empty() ? ""
                                     : html_table(section.grid, section.title, {"sortable", {}, "", {}, 0});
}

std::string apart(const History& history) {
    const Section section = history_apart(history);
    return table_of(section) + html_paragraphs(section.notes);
}

}  // namespace

std::string history_page(const History& history) {
    const Section changes = history_changes(history), runs = history_runs(history);
    const bool changed = !changes.grid.rows.empty();
    const std::string main =
        part("verdict", "What changed", html_paragraphs(newest_levels(history))) +
        part("changes", "Changes", changed ? to_html(changes) : "") +
        part("history", "Every case", lines_table(history)) +
        part("charts", "Charts",
             "<p class=\"no-script\">Charts need JavaScript; their figures are in the raw data, and drawn "
             "small in "
             "the table.</p>\n") +
        part("runs", "The runs", table_of(runs) + html_paragraphs(runs.notes)) +
        part("apart", "Left out, or kept apart", apart(history)) +
        part("raw", "Raw data",
             "<p class=\"no-script\">The history is in this page; JavaScript unpacks it.</p>\n");
    return framed(
        fmt::format("ptbench: a history of {} runs", history.runs.size()), main,
        {packed_text(history_text(history))},
        {"chart.min.js", "data.js", "tables.js", "pictures.js", "charts.js", "history.js", "page.js"});
}

}  // namespace ptb
