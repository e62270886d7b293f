#include "bench/report/html/page.h"

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

/// Once for a single run; under its name for each of several, in headings with `ids` where there are any.
template <class Make>
std::string of_each(const std::vector<PageRun>& runs, Make make, std::string (*ids)(std::size_t) = nullptr) {
    std::string html;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const std::string content = make(runs[i], i);
        const bool named = runs.size() > 1 && !content.empty();
        const std::string id = ids != nullptr ? fmt::format(" id=\"{}\"", ids(i)) : "";
        html += (named ? fmt::format("<h3{}>{}</h3>\n", id, html_text(run_name(runs, i))) : "") + content;
    }
    return html;
}

std::string title(const std::vector<PageRun>& runs) {
    const std::string first = "ptbench: " + run_name(runs, 0);
    return runs.size() == 1 ? first : fmt::format("{} and {} more", first, runs.size() - 1);
}

std::string verdict(const PageRun& run, std::size_t) {
    return html_paragraphs(summary_section(run.result).notes) +
           fmt::format("<p class=\"facts\">{}</p>\n", html_text(machine_text(run.result)));
}

std::string pictures(const PageRun& run, std::size_t) {
    std::string html;
    for (const Figure& figure : run.figures) {
        const std::string caption = html_text(figure.caption);
        const std::string image = figure.webp.empty()
                                      ? ""
                                      : fmt::format("<img alt=\"{}\" src=\"data:image/webp;base64,{}\">",
                                                    caption, base64(figure.webp));
        html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", image, caption);
    }
    if (run.figures.empty()) return "<p>The result file names no picture.</p>\n";
    return fmt::format("<div class=\"pictures\">{}</div>\n", html);
}

/// Their rows lead to cases; page/sweeps.js draws their bars.
std::string sweep_tables(const ResultFile& result, std::size_t index) {
    std::string html;
    for (const Section& section : sweep_sections(result)) {
        TableExtras extras{"sweep", {}, "", {}, 0};
        for (const std::size_t c : section.grid.cases) extras.links.push_back(case_id(index, c));
        html += html_table(section.grid, section.title, extras) + html_paragraphs(section.notes);
    }
    return html;
}

std::string tables(const PageRun& run, std::size_t index) {
    std::string html;
    const ResultFile& r = run.result;
    for (const Section& section : {devices_section(r), kernels_section(r), peaks_section(r.peaks),
                                   limits_section(r.cases), fits_section(r), problems_section(r)})
        if (!section.grid.rows.empty()) html += to_html(section);
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

}  // namespace

std::string page(const std::vector<PageRun>& runs, const PublishedTable& published) {
    const std::string main =
        part("verdict", "What came out", runs_table(runs) + of_each(runs, verdict, run_id)) +
        part("times", "Times", times_table(runs, published)) +
        part("charts", "Charts",
             "<p class=\"no-script\">Charts need JavaScript; their figures are in the tables.</p>\n") +
        part("pictures", "Pictures", of_each(runs, pictures)) +
        part("tables", "Tables", of_each(runs, tables)) +
        part("cases", "Every case", of_each(runs, case_list) + of_each(runs, facts)) +
        part("raw", "Raw data",
             "<p class=\"no-script\">The result files are in this page; JavaScript unpacks them.</p>\n");
    std::vector<std::string> data;
    for (std::size_t i = 0; i < runs.size(); ++i)
        data.push_back(packed(runs[i].result, runs[i].name.empty() ? run_name(runs, i) : runs[i].name));
    return framed(title(runs), main, data,
                  {"chart.min.js", "data.js", "tables.js", "pictures.js", "charts.js", "roofline.js",
                   "sweeps.js", "page.js"});
}

}  // namespace ptb
