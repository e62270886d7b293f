#include "bench/report/html/page.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/record/json.h"
#include "bench/report/html/frame.h"
#include "bench/report/html/html.h"
#include "bench/report/html/packed.h"
#include "bench/report/html/parts.h"
#include "bench/report/sections.h"
#include "core/input/base64.h"

namespace ptb {
namespace {

std::string machine_text(const ResultFile& r) {
    return fmt::format(
        "{}: {}, {} cores, {:.0f} GiB; {}, {}; load {:.2g}; ptbench {} ({}{}), config {}, seed {}",
        r.host.hostname, r.host.cpu, r.host.cores, static_cast<double>(r.host.memory_bytes) / (1u << 30),
        r.host.os, r.host.kernel, r.host.load_1min, r.run.tool_version, r.run.git_sha,
        r.run.git_dirty ? ", changed" : "", r.run.config, r.run.seed);
}

/// Once for a single run; under its name for each of several.
template <class Make>
std::string of_each(const std::vector<PageRun>& runs, Make make) {
    std::string html;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::string content = make(runs[i], i);
        const bool named = runs.size() > 1 && !content.empty();
        html += (named ? fmt::format("<h3>{}</h3>\n", html_text(run_name(runs, i))) : "") + content;
    }
    return html;
}

std::vector<std::string> dates(const std::vector<PageRun>& runs) {
    std::vector<std::string> all;
    for (const PageRun& run : runs) all.push_back(run.result.run.started_at.substr(0, 10));
    std::sort(all.begin(), all.end());
    return all;
}

std::string title(const std::vector<PageRun>& runs) {
    if (runs.size() == 1) return "ptbench: " + run_name(runs, 0);
    return fmt::format("ptbench: {} runs, {} to {}", runs.size(), dates(runs).front(), dates(runs).back());
}

std::string verdict(const PageRun& run, std::size_t) {
    return html_paragraphs(summary_section(run.result).notes) +
           fmt::format("<p class=\"facts\">{}</p>\n", html_text(machine_text(run.result)));
}

std::string figure(const Figure& shown) {
    const std::string caption = html_text(shown.caption);
    const std::string image =
        shown.webp.empty()
            ? ""
            : fmt::format("<img alt=\"{}\" src=\"data:image/webp;base64,{}\">", caption, base64(shown.webp));
    return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", image, caption);
}

/// Those of one group side by side, under its title.
std::string pictures(const std::vector<Figure>& figures) {
    std::string html;
    for (std::size_t i = 0; i < figures.size();) {
        const std::string& group = figures[i].group;
        std::string together;
        for (; i < figures.size() && figures[i].group == group; ++i) together += figure(figures[i]);
        if (!group.empty()) html += fmt::format("<h4>{}</h4>\n", html_text(group));
        html += fmt::format("<div class=\"pictures\">{}</div>\n", together);
    }
    return html;
}

/// A table whose rows lead to cases.
std::string leading_table(const Section& section, std::size_t index, const std::string& css_class) {
    if (section.grid.rows.empty()) return "";
    TableExtras extras{css_class, {}, "", {}, 0};
    for (const std::size_t c : section.grid.cases) extras.links.push_back(case_id(index, c));
    return html_table(section.grid, section.title, extras) + html_paragraphs(section.notes);
}

/// page/sweeps.js draws their bars.
std::string sweep_tables(const ResultFile& result, std::size_t index) {
    std::string html;
    for (const Section& section : sweep_sections(result)) html += leading_table(section, index, "sweep");
    return html;
}

std::string tables(const PageRun& run, std::size_t index) {
    std::string html;
    const ResultFile& r = run.result;
    for (const Section& section :
         {devices_section(r), kernels_section(r), shared_section(r), peaks_section(r.peaks),
          limits_section(r.cases), trees_section(r.cases), fits_section(r), problems_section(r)})
        if (!section.grid.rows.empty()) html += to_html(section);
    for (const Section& section : {efficiency_section(r), noise_section(r)})
        html += leading_table(section, index, "noise");
    return html + work_group_maps(r) + sweep_tables(r, index) + to_html(remarks_section(r));
}

std::string facts(const PageRun& run, std::size_t) {
    const ResultFile& r = run.result;
    const Json json = {{"run", encode(r.run)},
                       {"host", encode(r.host)},
                       {"devices", encode(r.devices)},
                       {"drivers that cannot be used", encode(r.broken_icds)}};
    return fmt::format("<details><summary>devices, host, command line, seeds, hashes</summary>{}</details>\n",
                       html_facts(json));
}

std::vector<Ranking> rankings_of(const std::vector<PageRun>& runs, const PublishedTable& published) {
    std::vector<const ResultFile*> results;
    for (const PageRun& run : runs) results.push_back(&run.result);
    return rankings(results, published);
}

std::string device_id(std::size_t group) { return fmt::format("device-{}", group); }

/// What can be seen of several runs, each reference once.
std::vector<Figure> figures_of(const std::vector<PageRun>& runs, const RunGroup& group) {
    std::vector<Figure> all;
    for (const std::size_t i : group.runs)
        for (const Figure& each : runs[i].figures)
            if (!each.webp.empty() && std::find(all.begin(), all.end(), each) == all.end())
                all.push_back(each);
    return all;
}

/// Why pictures are not there.
std::vector<std::string> without_picture(const PageRun& run) {
    std::vector<std::string> captions;
    for (const Figure& each : run.figures)
        if (each.webp.empty()) captions.push_back(each.caption);
    return captions;
}

/// A run among others: what came out in sentences, and its tables folded.
std::string run_part(const std::vector<PageRun>& runs, std::size_t i) {
    return fmt::format("<h4 id=\"{}\">{}</h4>\n{}<details><summary>tables</summary>{}{}</details>\n",
                       run_id(i), html_text(run_name(runs, i)), verdict(runs[i], i), tables(runs[i], i),
                       html_paragraphs(without_picture(runs[i])));
}

/// Devices with their pictures and charts, then what each of their runs found.
std::string device_part(const std::vector<PageRun>& runs, const RunGroup& group, std::size_t index) {
    std::string html = fmt::format("<h3 id=\"{}\">{}</h3>\n", device_id(index), html_text(group.name));
    html += pictures(figures_of(runs, group));
    html += fmt::format("<div class=\"charts-of\" data-runs=\"{}\"></div>\n", fmt::join(group.runs, " "));
    for (const std::size_t i : group.runs) html += run_part(runs, i);
    return html;
}

std::string device_parts(const std::vector<PageRun>& runs, const std::vector<RunGroup>& groups) {
    std::string html;
    for (std::size_t i = 0; i < groups.size(); ++i) html += device_part(runs, groups[i], i);
    return html;
}

/// Of each run, where its devices' part is; a single run has one for all, its pictures.
std::vector<std::string> device_links(const std::vector<PageRun>& runs, const std::vector<RunGroup>& groups) {
    std::vector<std::string> links(runs.size(), "pictures");
    for (std::size_t g = 0; g < groups.size() && runs.size() > 1; ++g)
        for (const std::size_t i : groups[g].runs) links[i] = device_id(g);
    return links;
}

std::string pictures_or_why_none(const PageRun& run) {
    return run.figures.empty() ? "<p>The result file names no picture.</p>\n" : pictures(run.figures);
}

/// What is told of a single run, or of each of several by its devices.
std::string what_came_out(const std::vector<PageRun>& runs, const std::vector<RunGroup>& groups) {
    if (runs.size() == 1)
        return part("pictures", "Pictures", pictures_or_why_none(runs.front())) +
               part("verdict", "What came out", verdict(runs.front(), 0));
    return part("devices", "Devices", device_parts(runs, groups)) +
           part("verdict", "The runs", runs_table(runs));
}

}  // namespace

std::string page(const std::vector<PageRun>& runs, const PublishedTable& published) {
    const auto rankings = rankings_of(runs, published);
    const auto groups = run_groups(runs, rankings);
    const std::string main =
        part("board", "Fastest first", boards(rankings, device_links(runs, groups))) +
        what_came_out(runs, groups) + part("times", "Times", times_table(runs, published)) +
        part("charts", "Charts",
             "<p class=\"no-script\">Charts need JavaScript; their figures are in the tables.</p>\n") +
        part("tables", "Tables", runs.size() == 1 ? tables(runs.front(), 0) : "") +
        part("cases", "Every case", of_each(runs, case_list) + of_each(runs, facts)) +
        part("raw", "Raw data",
             "<p class=\"no-script\">The result files are in this page; JavaScript unpacks them.</p>\n");
    std::vector<std::string> data;
    for (std::size_t i = 0; i < runs.size(); ++i)
        data.push_back(packed(runs[i].result, runs[i].name.empty() ? run_name(runs, i) : runs[i].name));
    return framed(title(runs), main, data,
                  {"chart.min.js", "data.js", "tables.js", "pictures.js", "charts.js", "roofline.js",
                   "efficiency.js", "sweeps.js", "page.js"});
}

}  // namespace ptb
