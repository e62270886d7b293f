#include <fmt/format.h>

#include "bench/report/html/html.h"
#include "bench/report/html/parts.h"
#include "bench/report/words.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr std::size_t most_log = 4000;  ///< characters; the raw data has all

std::string ms_text(double ns) { return number_text(ms(ns)); }

std::string times(const Statistics& s) {
    const std::string interval =
        s.ci_low_ns && s.ci_high_ns
            ? fmt::format(" ({} to {})", ms_text(*s.ci_low_ns), ms_text(*s.ci_high_ns))
            : "";
    return fmt::format("median {}{}, MAD {}, mean {}, least {}, quartiles {} and {}, most {}",
                       ms_text(s.median_ns), interval, ms_text(s.mad_ns), ms_text(s.mean_ns),
                       ms_text(s.min_ns), ms_text(s.q1_ns), ms_text(s.q3_ns), ms_text(s.max_ns));
}

std::string samples(const Statistics& s) {
    const std::string clock =
        s.timer_reason.empty() ? s.timer : fmt::format("{} ({})", s.timer, s.timer_reason);
    return fmt::format("{}, {} flagged, clock: {}, ended by {}", s.n, s.flagged, clock, s.stop_reason);
}

std::string image(const Validation& v) {
    std::string text = fmt::format("{}, against {}", v.valid ? "right" : "wrong: " + v.reason, v.against);
    if (v.max_abs_z && v.z_limit) text += fmt::format(", block z {:.2f} of {:.2f}", *v.max_abs_z, *v.z_limit);
    if (v.mean_z) text += fmt::format(", mean z {:.2f}", *v.mean_z);
    return text + fmt::format(", {:.2f} segments a sample", v.segments_per_sample);
}

std::string noise_text(const char* pixels, const Noise& n) {
    std::string text = fmt::format("relMSE {} (standard error {}) of {}", number_text(n.rel_mse),
                                   number_text(n.standard_error), pixels);
    if (n.efficiency) text += fmt::format(", efficiency {} 1/s", number_text(*n.efficiency));
    if (n.low && n.high) text += fmt::format(" ({} to {})", number_text(*n.low), number_text(*n.high));
    return text;
}

std::string noise(const Efficiency& e) {
    std::vector<std::string> parts;
    if (e.all) parts.push_back(noise_text("all pixels", *e.all));
    if (e.best_99) parts.push_back(noise_text("the best 99 %", *e.best_99));
    if (e.all) parts.push_back("variance of the " + e.variance_from);
    if (!e.reason.empty()) parts.push_back(e.reason);
    return fmt::format("{}", fmt::join(parts, "; "));
}

std::string build(const Build& b) {
    return fmt::format("kernel {}{}, {} ms", b.kernel_hash, b.overridden ? " (overridden)" : "",
                       number_text(b.build_ms));
}

std::string tree(const TreeRecord& t) {
    return fmt::format("{} of {} triangles: {} references, {} nodes, {} bytes, SAH cost {}, built in {} ms",
                       t.layout, t.triangles, t.references, t.nodes, t.bytes, number_text(t.sah_cost),
                       number_text(t.build_ms));
}

std::string item(const char* name, const std::string& text) {
    return text.empty() ? "" : fmt::format("<dt>{}<dd>{}", name, html_text(text));
}

}  // namespace

std::string record_facts(const Record& record) {
    const auto& b = record.build;
    const auto& energy = record.energy;
    std::string items = item("reason", record.reason);
    if (const auto& s = record.statistics)
        items += item("times, ms", times(*s)) + item("samples", samples(*s));
    if (record.validation) items += item("image", image(*record.validation));
    if (record.efficiency) items += item("noise", noise(*record.efficiency));
    if (energy && energy->joules) items += item("energy", number_text(*energy->joules) + " J a render");
    if (b) items += item("build", build(*b));
    if (record.tree) items += item("tree", tree(*record.tree));
    if (b && !b->log.empty() && !timed(record))
        items += fmt::format("<dt>build log<dd><pre>{}</pre>", html_lines(shortened(b->log, most_log)));
    return items.empty() ? "" : fmt::format("<noscript><dl>{}</dl></noscript>", items);
}

}  // namespace ptb
