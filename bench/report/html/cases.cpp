#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "bench/compare/row.h"
#include "bench/plan/config.h"
#include "bench/record/status.h"
#include "bench/report/html/html.h"
#include "bench/report/html/parts.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

constexpr int shades = 8;

std::string outcome_text(const Record& record) {
    const std::string status = to_string(record.status) + (record.reason.empty() ? "" : ": " + record.reason);
    if (!timed(record)) return status;
    const std::string spread = spread_text(*record.statistics);
    const std::string time =
        number_text(ms(record.statistics->median_ns)) + (spread == "-" ? " ms" : " ms +- " + spread + " %");
    return record.status == Status::ok ? time : time + ", " + status;
}

/// Times by work-group of cases that are otherwise the same; of each work that with the most samples.
using Map = std::map<WorkGroup, const Record*>;

std::map<Case, Map> maps_of(const ResultFile& result) {
    std::map<Case, Map> maps;
    for (const Record& record : result.cases) {
        if (!timed(record) || !record.params.work_group.two_dimensional()) continue;
        Case c = record.params;
        c.work_group = {};
        maps[c][record.params.work_group] = &record;
    }
    const auto fewer_samples = [&](const Case& c) {
        return std::any_of(maps.begin(), maps.end(), [&](const auto& other) {
            Case same = other.first;
            same.spp = c.spp;
            return same == c && other.first.spp > c.spp;
        });
    };
    std::map<Case, Map> shown;
    for (const auto& [c, map] : maps)
        if (map.size() > 2 && !fewer_samples(c)) shown[c] = map;
    return shown;
}

/// 0 for the fastest, up to the last shade for a time twice as long.
int shade(double ns, double fastest) {
    return std::clamp(static_cast<int>((ns / fastest - 1) * shades), 0, shades - 1);
}

std::string map_cell(const Map& map, WorkGroup group, const Statistics& fastest) {
    const auto found = map.find(group);
    if (found == map.end()) return "<td>-";
    const double ns = found->second->statistics->median_ns;
    const std::string mark = mark_text(*found->second, fastest);
    return fmt::format("<td class=\"n shade-{}\">{}{}", shade(ns, fastest.median_ns), number_text(ms(ns)),
                       mark.empty() ? "" : " (" + mark + ")");
}

std::string map_table(const ResultFile& result, const Case& c, const Map& map) {
    std::set<int> widths, heights;
    const auto fastest = std::min_element(
        map.begin(), map.end(), [](const auto& a, const auto& b) { return faster(*a.second, *b.second); });
    for (const auto& [group, record] : map) {
        widths.insert(group.x);
        heights.insert(group.y);
    }
    std::string head, body;
    for (const int x : widths) head += fmt::format("<th scope=col class=n>{}", x);
    for (const int y : heights) {
        body += fmt::format("<tr><th scope=row class=n>{}", y);
        for (const int x : widths) body += map_cell(map, {x, y}, *fastest->second->statistics);
        body += "</tr>\n";
    }
    const std::string caption = fmt::format("work-groups of {}, {}: ms, widths across, heights down",
                                            device_label(result, c.device), case_text(c));
    return fmt::format(
        "<div class=\"scroll\" tabindex=\"0\"><table><caption>{}</caption><thead><tr><td>{}</tr>"
        "<tbody>\n{}</table></div>\n",
        html_text(caption), head, body);
}

}  // namespace

std::string work_group_maps(const ResultFile& result) {
    std::string html;
    for (const auto& [c, map] : maps_of(result)) html += map_table(result, c, map);
    return html;
}

std::string case_id(std::size_t run, std::size_t index) { return fmt::format("r{}c{}", run, index); }

std::string case_list(const PageRun& run, std::size_t index) {
    std::string html;
    for (std::size_t i = 0; i < run.result.cases.size(); ++i) {
        const Record& record = run.result.cases[i];
        html += fmt::format("<details id={}><summary>{} {}: {}</summary>{}</details>\n", case_id(index, i),
                            html_text(record.params.device), html_text(case_text(record.params)),
                            html_text(outcome_text(record)), record_facts(record));
    }
    return fmt::format("<details class=\"all-cases\"><summary>{} cases</summary>\n{}</details>\n",
                       run.result.cases.size(), html);
}

}  // namespace ptb
