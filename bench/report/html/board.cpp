#include <algorithm>

#include <fmt/format.h>

#include "bench/report/html/html.h"
#include "bench/report/html/parts.h"
#include "bench/report/ranking.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// Of 1000 units that the longest bar is.
double length(double value, double most) {
    return most > 0 ? std::clamp(1000 * value / most, 0.0, 1000.0) : 0;
}

std::string interval_mark(const Standing& standing, double most) {
    if (!standing.interval) return "";
    return fmt::format("<path class=\"interval\" d=\"M{0:.1f} 5H{1:.1f}M{0:.1f} 2V8M{1:.1f} 2V8\"/>",
                       length(standing.interval->low, most), length(standing.interval->high, most));
}

std::string bar(const Standing& standing, double most) {
    constexpr double least = 3;  // what has a value can be seen
    return fmt::format(
        "<svg viewBox=\"0 0 1000 10\" preserveAspectRatio=\"none\" aria-hidden=\"true\"><rect{} "
        "width=\"{:.1f}\" "
        "height=\"10\"/>{}</svg>",
        standing.run ? "" : " class=\"published\"", std::max(length(standing.value, most), least),
        interval_mark(standing, most));
}

std::string device_cell(const Standing& standing, const std::vector<std::string>& links) {
    const std::string name = html_text(standing.device);
    return standing.run ? fmt::format("<a href=\"#{}\">{}</a>", html_text(links[*standing.run]), name) : name;
}

std::string sureness_text(const Standing& standing) {
    if (!standing.interval) return "";
    return fmt::format(" <small>&plusmn; {:.2g} %</small>",
                       50 * (standing.interval->high - standing.interval->low) / standing.value);
}

std::string board_row(const Standing& standing, std::size_t place, double most,
                      const std::vector<std::string>& links) {
    return fmt::format(
        "<tr><td class=n>{}<td class=who>{}<td class=bar>{}<td class=n>{}{}<td class=how>{}</tr>\n", place,
        device_cell(standing, links), bar(standing, most), number_text(standing.value),
        sureness_text(standing), html_text(standing.detail));
}

std::string board_table(const Ranking& ranking, const std::vector<std::string>& links) {
    const double most = ranking.standings.front().value;
    std::string rows;
    for (std::size_t i = 0; i < ranking.standings.size(); ++i)
        rows += board_row(ranking.standings[i], i + 1, most, links);
    const std::string said = ranking.note.empty() ? ranking.work : ranking.work + ". " + ranking.note;
    return fmt::format(
        "<table class=\"board\"><caption>{}: {}</caption><thead><tr><th scope=col class=n>#<th scope=col "
        "class=who>device<th scope=col class=bar>more is better<th scope=col class=n>{}<th scope=col "
        "class=how>measured</tr><tbody>\n{}</table><p>{}</p>\n",
        html_text(ranking.title), html_text(ranking.unit), html_text(ranking.unit), rows, html_text(said));
}

}  // namespace

std::string boards(const std::vector<Ranking>& rankings, const std::vector<std::string>& links) {
    std::string html;
    for (std::size_t i = 0; i < rankings.size(); ++i)
        html += fmt::format(
            "<input type=\"radio\" name=\"ranking\" id=\"rank-{0}\"{1}><label "
            "for=\"rank-{0}\">{2}</label><div "
            "class=\"ranking\">{3}</div>\n",
            i, i == 0 ? " checked" : "", html_text(rankings[i].title), board_table(rankings[i], links));
    return html.empty() ? "" : fmt::format("<div class=\"rankings\">{}</div>\n", html);
}

}  // namespace ptb
