#include "bench/report/fleet.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/html/frame.h"
#include "bench/report/html/html.h"

namespace ptb {
namespace {

/// Of a strip chart, in its own units.
constexpr double width = 1000, height = 240, left = 60, right = 10, top = 10, bottom = 30;
constexpr double least_range = 0.05;  ///< of log time, to either side

struct Scale {
    double low, high;  ///< of log time
    std::size_t cards;

    double x(std::size_t card) const {
        return left + (width - left - right) * (static_cast<double>(card) + 0.5) / static_cast<double>(cards);
    }
    double y(double deviation) const {
        return top + (height - top - bottom) * (high - deviation) / (high - low);
    }
};

Scale scale_of(const JudgedClass& each) {
    Scale scale{-least_range, least_range, each.of.cards.size()};
    for (const double deviation : each.screened.deviation) {
        if (std::isnan(deviation)) continue;
        scale.low = std::min(scale.low, 1.1 * deviation);
        scale.high = std::max(scale.high, 1.1 * deviation);
    }
    return scale;
}

std::string level(const Scale& scale, double deviation) {
    return fmt::format(
        "<line class=\"zero\" x1=\"{0:.0f}\" x2=\"{1:.0f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>"
        "<text x=\"{3:.0f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>",
        left, width - right, scale.y(deviation), left - 5, scale.y(deviation) + 4, slower_text(deviation));
}

std::string dot(const Judged& judged, const Scale& scale, std::size_t place, std::size_t card,
                double deviation) {
    const std::string finding = finding_text(judged, card);
    const bool stands_out = finding != "ok";
    return fmt::format(
        "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{} {}{}</title></circle>\n",
        stands_out ? "bad" : "dot", scale.x(place), scale.y(deviation), stands_out ? 5 : 3,
        html_text(label(judged.fleet.cards[card])), slower_text(deviation),
        stands_out ? html_text(" " + finding) : "");
}

/// Names of some nodes, below their first cards.
std::string node_names(const Judged& judged, const JudgedClass& each, const Scale& scale) {
    constexpr std::size_t most = 8;
    const std::size_t step = std::max<std::size_t>(1, (each.of.cards.size() + most - 1) / most);
    std::string html;
    for (std::size_t i = 0; i < each.of.cards.size(); i += step)
        html += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\">{}</text>", scale.x(i), height - 8,
                            html_text(judged.fleet.cards[each.of.cards[i]].node));
    return html;
}

std::string strip_chart(const Judged& judged, const JudgedClass& each) {
    const Scale scale = scale_of(each);
    const std::string name = judged.fleet.cards[each.of.cards.front()].device.name;
    std::string html = fmt::format(
        "<figure><svg class=\"fleet\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"How much "
        "slower each {} "
        "is than most\">",
        width, height, html_text(name));
    for (const double deviation : {scale.low, 0.0, std::log1p(slow_by), scale.high})
        html += level(scale, deviation);
    for (std::size_t i = 0; i < each.of.cards.size(); ++i)
        if (!std::isnan(each.screened.deviation[i]))
            html += dot(judged, scale, i, each.of.cards[i], each.screened.deviation[i]);
    return html + node_names(judged, each, scale) +
           fmt::format(
               "</svg><figcaption>{} {}, driver {}: how much slower each is than their median, by "
               "node.</figcaption></figure>\n",
               each.of.cards.size(), html_text(name),
               html_text(judged.fleet.cards[each.of.cards.front()].device.driver_version));
}

std::string findings(const std::vector<Section>& sections) {
    std::string html;
    for (const Section& section : sections) html += to_html(section);
    return html;
}

}  // namespace

std::string fleet_page(const Judged& judged, const std::string& folder) {
    std::string charts;
    for (const JudgedClass& each : judged.classes)
        if (!each.screened.too_few) charts += strip_chart(judged, each);
    const Section cards = cards_section(judged);
    const std::string main =
        part("verdict", "What came out", findings(fleet_sections(judged, folder))) +
        part("classes", "Equal devices", charts) +
        part("cards", "All devices", html_table(cards.grid, cards.title, {"sortable", {}, {}, {}, 0}));
    return framed("ptbench: a fleet", main, {}, {"data.js", "tables.js", "fleet.js"});
}

}  // namespace ptb
