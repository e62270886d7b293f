#include "bench/report/ranking.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/report/axes.h"
#include "bench/report/words.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

/// A record that may be ranked, and whose it is.
struct Entry {
    Record record;
    std::size_t run = 0;
    std::string device, started_at;
};

struct Rate {
    double value = 0;
    std::optional<Interval> interval;
};

/// What is measured of a record, if it is.
using Measure = std::optional<Rate> (*)(const Record&);

std::optional<Rate> msegments_per_s(const Record& record) {
    const Statistics& s = *record.statistics;
    if (!(s.msegments_per_s > 0)) return std::nullopt;
    Rate rate{s.msegments_per_s, std::nullopt};
    if (s.ci_low_ns && s.ci_high_ns)
        rate.interval =
            Interval{rate.value * s.median_ns / *s.ci_high_ns, rate.value * s.median_ns / *s.ci_low_ns};
    return rate;
}

/// Time grows with the pixels and the noise of each does not, so it is told of a megapixel.
std::optional<Rate> efficiency_of_megapixel(const Record& record) {
    if (!record.efficiency || !record.efficiency->all || !record.efficiency->all->efficiency)
        return std::nullopt;
    const Noise& noise = *record.efficiency->all;
    const double megapixels = static_cast<double>(record.params.size.pixels()) / 1e6;
    Rate rate{*noise.efficiency * megapixels, std::nullopt};
    if (noise.low && noise.high) rate.interval = Interval{*noise.low * megapixels, *noise.high * megapixels};
    return rate;
}

std::optional<Rate> msegments_per_joule(const Record& record) {
    if (!record.energy || !record.energy->samples_per_joule || !record.work) return std::nullopt;
    const auto samples = static_cast<double>(record.work->samples),
               segments = static_cast<double>(record.work->segments);
    return Rate{*record.energy->samples_per_joule * segments / samples / 1e6, std::nullopt};
}

/// A case but for its device, kernel and how much of it was done.
Case work_of(Case c) {
    c.device.clear();
    c.kernel.clear();
    c.size = {};
    c.spp = c.lanes = 0;
    return c;
}

/// Entries of one work: the usual one where there is any, else that of the most cases.
std::vector<Entry> entries_of(const std::vector<const ResultFile*>& runs) {
    std::map<Case, std::vector<Entry>> works;
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (const Record& record : comparable(*runs[i]))
            works[work_of(record.params)].push_back(
                {record, i, device_label(*runs[i], record.params.device), runs[i]->run.started_at});
    const auto rank = [](const auto& work) {
        return std::tuple(unusual(work.first, other_axes()) == 0, work.second.size());
    };
    const auto best = std::max_element(works.begin(), works.end(),
                                       [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    return best == works.end() ? std::vector<Entry>() : best->second;
}

std::string detail_of(const Record& record) {
    const Case& c = record.params;
    return fmt::format("{} samples per pixel at {}{}", c.spp, to_string(c.size),
                       record.status == Status::unstable ? ", unstable" : "");
}

/// Of each device the case of the most samples, of those whose median has an interval where any has; of equal
/// ones that of the usual lanes, of the newest run.
std::vector<Standing> standings_of(const std::vector<Entry>& entries, const std::string& kernel,
                                   Measure measure) {
    const auto rank = [](const Entry& e) {
        const Case& c = e.record.params;
        return std::tuple(e.record.statistics->ci_low_ns.has_value(),
                          1.0 * c.spp * static_cast<double>(c.size.pixels()), c.lanes == 0, e.started_at);
    };
    std::map<std::string, const Entry*> of_device;
    for (const Entry& entry : entries) {
        if (entry.record.params.kernel != kernel || !measure(entry.record)) continue;
        const Entry*& best = of_device[entry.device];
        if (best == nullptr || rank(*best) < rank(entry)) best = &entry;
    }
    std::vector<Standing> standings;
    for (const auto& [device, entry] : of_device) {
        const Rate rate = *measure(entry->record);
        standings.push_back({device, detail_of(entry->record), rate.value, rate.interval, entry->run});
    }
    return standings;
}

/// Segments a sample of a kernel, as counted; 0 where it did not run.
double segments_a_sample(const std::vector<Entry>& entries, const std::string& kernel) {
    for (const Entry& e : entries)
        if (e.record.params.kernel == kernel && e.record.work && e.record.work->samples > 0)
            return static_cast<double>(e.record.work->segments) / static_cast<double>(e.record.work->samples);
    return 0;
}

/// Each published device by its row of the most samples.
std::vector<Standing> published_standings(const PublishedTable& table, const std::vector<Entry>& entries) {
    const double segments = segments_a_sample(entries, table.kernel);
    const Case work = entries.empty() ? Case() : work_of(entries.front().record.params);
    std::map<std::string, const PublishedRow*> of_device;
    for (const PublishedRow& row : table.rows) {
        const bool same = row.path_length == work.path_length && table.scene == work.scene;
        const PublishedRow*& most = of_device[row.device];
        if (same && segments > 0 && (most == nullptr || row.spp > most->spp)) most = &row;
    }
    std::vector<Standing> standings;
    for (const auto& [device, row] : of_device) {
        if (row == nullptr) continue;
        const double samples = 1.0 * row->spp * static_cast<double>(row->size.pixels());
        standings.push_back(
            {fmt::format("{} ({})", device, table.year),
             fmt::format("{}, {} samples per pixel at {}", table.kernel, row->spp, to_string(row->size)),
             samples * segments / row->time_ms / 1e3});
    }
    return standings;
}

std::vector<std::string> kernels_in_order() {
    std::vector<std::string> kernels{base_kernel};
    for (const Integrator& each : integrators())
        if (each.id != base_kernel) kernels.push_back(each.id);
    return kernels;
}

void append(std::vector<Ranking>& all, Ranking ranking) {
    if (ranking.standings.empty()) return;
    std::stable_sort(ranking.standings.begin(), ranking.standings.end(),
                     [](const Standing& a, const Standing& b) { return a.value > b.value; });
    all.push_back(std::move(ranking));
}

}  // namespace

std::vector<Ranking> rankings(const std::vector<const ResultFile*>& runs, const PublishedTable& published) {
    const auto entries = entries_of(runs);
    const auto old = published_standings(published, entries);
    const std::string old_note =
        old.empty()
            ? ""
            : fmt::format(
                  "{}: samples a second as published, times the segments that {} traces in a sample here",
                  published.year, published.kernel);
    std::vector<Ranking> all;
    for (const std::string& kernel : kernels_in_order()) {
        Ranking ranking{kernel, "Msegments/s", "", standings_of(entries, kernel, msegments_per_s)};
        if (!ranking.standings.empty() && (kernel == base_kernel || kernel == published.kernel)) {
            ranking.standings.insert(ranking.standings.end(), old.begin(), old.end());
            ranking.note = old_note;
        }
        append(all, ranking);
    }
    for (const std::string& kernel : kernels_in_order())
        append(all, {kernel + ", efficiency", "1/(relMSE s) of a megapixel", "",
                     standings_of(entries, kernel, efficiency_of_megapixel)});
    for (const std::string& kernel : kernels_in_order())
        append(all, {kernel + ", per joule", "Msegments/J", "",
                     standings_of(entries, kernel, msegments_per_joule)});
    return all;
}

}  // namespace ptb
