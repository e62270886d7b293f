#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/changes.h"
#include "bench/report/html/frame.h"
#include "bench/report/html/html.h"
#include "bench/report/html/packed.h"
#include "bench/report/html/page.h"

namespace ptb {
namespace {

/// The middle of a forest plot is a ratio of 1; its ends are `range` of log ratio away.
constexpr double middle = 100;
constexpr std::size_t most_sentences = 6;
constexpr double least_range = 0.1, most_range = 1.5;

double range_of(const std::vector<Row>& rows) {
    double range = least_range;
    for (const Row& row : rows) {
        const Evidence& e = row.finding.evidence;
        if (!row.compared()) continue;
        range = std::max({range, std::abs(e.shift.value), std::log1p(row.finding.smallest_effect)});
        if (e.shift.interval)
            range = std::max({range, std::abs(e.shift.interval->low), std::abs(e.shift.interval->high)});
    }
    return std::min(range, most_range);
}

double x_of(double log_ratio, double range) {
    return middle + 0.95 * middle * std::clamp(log_ratio / range, -1.0, 1.0);
}

std::string interval_line(const Shift& shift, double range) {
    if (!shift.interval) return "";
    return fmt::format("<line class=\"interval\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"10\" y2=\"10\"/>",
                       x_of(shift.interval->low, range), x_of(shift.interval->high, range));
}

std::string plot(const Row& row, double range) {
    if (!row.compared()) return "-";
    const Finding& f = row.finding;
    const double unseen = std::isfinite(f.smallest_effect) ? std::log1p(f.smallest_effect) : range;
    const double left = x_of(-unseen, range);
    return fmt::format(
        "<svg class=\"forest\" viewBox=\"0 0 200 20\" aria-hidden=\"true\">"
        "<rect class=\"unseen\" x=\"{:.1f}\" width=\"{:.1f}\" y=\"3\" height=\"14\"/>"
        "<line class=\"zero\" x1=\"100\" x2=\"100\" y1=\"0\" y2=\"20\"/>{}"
        "<circle class=\"ratio\" cx=\"{:.1f}\" cy=\"10\" r=\"3.5\"/></svg>",
        left, 2 * (middle - left), interval_line(f.evidence.shift, range),
        x_of(f.evidence.shift.value, range));
}

std::string changed(const Row& row) {
    const Evidence& e = row.finding.evidence;
    const std::string sure =
        e.shift.interval ? fmt::format(", 95 % interval {:.3f} to {:.3f}", std::exp(e.shift.interval->low),
                                       std::exp(e.shift.interval->high))
                         : "";
    return fmt::format("{}: {} on {} takes {:.3f} times as long as before{}.", to_string(row.finding.state),
                       row.name, row.device, e.ratio(), sure);
}

/// The gravest first.
std::vector<std::string> changes(const std::vector<Row>& rows) {
    std::vector<std::string> sentences;
    for (const State state : {State::regressed, State::improved})
        for (const Row& row : rows)
            if (row.finding.state == state) sentences.push_back(changed(row));
    const std::size_t all = sentences.size();
    if (all <= most_sentences) return sentences;
    sentences.resize(most_sentences);
    sentences.push_back(fmt::format("{} more are in the table.", all - most_sentences));
    return sentences;
}

std::vector<std::string> verdict(const ComparedPage& compared) {
    std::vector<std::string> sentences = changes(compared.rows);
    if (sentences.empty() && !compared.rows.empty())
        sentences.emplace_back("No case is called regressed or improved.");
    if (compared.rows.empty())
        sentences.emplace_back("Nothing was compared.");
    else
        sentences.push_back(changes_section(compared.rows, "").notes.front() + ".");
    if (!compared.differing.empty())
        sentences.emplace_back("The sides differ in more than the change that is asked about: see below.");
    return sentences;
}

std::string forest(const ComparedPage& compared) {
    if (compared.rows.empty()) return "";
    const double range = range_of(compared.rows);
    const Section section = changes_section(compared.rows, compared.title);
    TableExtras extras{"sortable", {}, "faster | slower", {}, 2};
    for (const Row& row : compared.rows) extras.cells.push_back(plot(row, range));
    return html_table(section.grid, section.title, extras) + html_paragraphs(section.notes) +
           fmt::format(
               "<p>Plots: the ratio and its 95 % interval, from {:.2f} to {:.2f}, the middle being 1; grey: "
               "changes "
               "too small to be seen.</p>\n",
               std::exp(-range), std::exp(range));
}

std::string differences_list(const std::vector<std::string>& differing) {
    std::string items;
    for (const std::string& each : differing) items += fmt::format("<li>{}</li>", html_text(each));
    return items.empty() ? "<p>None that are known.</p>\n" : fmt::format("<ul>{}</ul>\n", items);
}

}  // namespace

std::string compared_page(const ComparedPage& compared) {
    const std::string main =
        part("verdict", "What changed",
             html_paragraphs(verdict(compared)) +
                 fmt::format("<p class=\"facts\">{}</p>\n", html_text(compared.title))) +
        part("changes", "Every case", forest(compared)) +
        part("differences", "Differences between the sides", differences_list(compared.differing)) +
        part("raw", "Raw data",
             "<p class=\"no-script\">The comparison is in this page; JavaScript unpacks it.</p>\n");
    return framed("ptbench: a comparison", main, {packed_text(compared.json)},
                  {"data.js", "tables.js", "pictures.js", "page.js"});
}

}  // namespace ptb
