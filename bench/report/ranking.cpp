#include "bench/report/ranking.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
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

std::vector<std::string> kernels_in_order() {
    std::vector<std::string> kernels{base_kernel};
    for (const Integrator& each : integrators())
        if (each.id != base_kernel) kernels.push_back(each.id);
    return kernels;
}

/// What devices are compared in.
struct KernelWork {
    std::string kernel;
    Case work;
    std::vector<Entry> entries;
    bool is_usual() const { return unusual(work, other_axes()) == 0; }
};

/// A kernel is ranked by the greatest of its works: the usual one, else that of the most devices.
auto worth(const KernelWork& w) {
    std::set<std::string> devices;
    for (const Entry& e : w.entries) devices.insert(e.device);
    return std::tuple(w.is_usual(), devices.size(), -unusual(w.work, other_axes()), w.entries.size());
}

std::vector<KernelWork> all_works(const std::vector<const ResultFile*>& runs) {
    std::map<std::pair<std::string, Case>, KernelWork> all;
    for (std::size_t i = 0; i < runs.size(); ++i)
        for (const Record& record : comparable(*runs[i])) {
            const std::string& kernel = record.params.kernel;
            const Case work = work_of(record.params);
            KernelWork& same = all.try_emplace({kernel, work}, KernelWork{kernel, work, {}}).first->second;
            same.entries.push_back(
                {record, i, device_label(*runs[i], record.params.device), runs[i]->run.started_at});
        }
    std::vector<KernelWork> works;
    for (auto& each : all) works.push_back(std::move(each.second));
    return works;
}

/// One of each kernel without triangles and one with them, where they ran, in the kernels' order.
std::vector<KernelWork> works_of(const std::vector<const ResultFile*>& runs) {
    std::map<std::tuple<std::size_t, std::string, bool>, KernelWork> best;
    const auto kernels = kernels_in_order();
    for (KernelWork& w : all_works(runs)) {
        const auto place = std::find(kernels.begin(), kernels.end(), w.kernel) - kernels.begin();
        const bool triangles = w.entries.front().record.tree.has_value();
        KernelWork& most = best[{static_cast<std::size_t>(place), w.kernel, triangles}];
        if (most.entries.empty() || worth(most) < worth(w)) most = std::move(w);
    }
    std::vector<KernelWork> works;
    for (auto& each : best) works.push_back(std::move(each.second));
    return works;
}

/// "pt"; "pt, flake" of another scene than the usual.
std::string title_of(const KernelWork& w) {
    const bool usual_scene = w.work.scene == default_case().scene;
    return usual_scene ? w.kernel
                       : fmt::format("{}, {}", w.kernel, std::filesystem::path(w.work.scene).stem().string());
}

/// "scene thesis, path length 128", and what else is unusual.
std::string text_of(Case work) {
    const std::string named = fmt::format("scene {}, path length {}", work.scene, work.path_length);
    work.scene = default_case().scene;
    work.path_length = default_case().path_length;
    return named + unusual_text(work);
}

std::string rays_or_segments(const std::string& kernel) {
    const bool rays = std::any_of(integrators().begin(), integrators().end(), [&](const Integrator& each) {
        return each.id == kernel && each.lists_rays;
    });
    return rays ? "Mrays" : "Msegments";
}

std::string detail_of(const Record& record) {
    const Case& c = record.params;
    return fmt::format("{} samples per pixel at {}{}", c.spp, to_string(c.size),
                       record.status == Status::unstable ? ", unstable" : "");
}

/// Of each device the case of the most samples, of those whose median has an interval where any has; of equal
/// ones that of the usual lanes, of the newest run.
std::vector<Standing> standings_of(const std::vector<Entry>& entries, Measure measure) {
    const auto rank = [](const Entry& e) {
        const Case& c = e.record.params;
        return std::tuple(e.record.statistics->ci_low_ns.has_value(),
                          1.0 * c.spp * static_cast<double>(c.size.pixels()), c.lanes == 0, e.started_at);
    };
    std::map<std::string, const Entry*> of_device;
    for (const Entry& entry : entries) {
        if (!measure(entry.record)) continue;
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

/// Segments a sample, as counted; 0 where they were not.
double segments_a_sample(const std::vector<Entry>& entries) {
    for (const Entry& e : entries)
        if (e.record.work && e.record.work->samples > 0)
            return static_cast<double>(e.record.work->segments) / static_cast<double>(e.record.work->samples);
    return 0;
}

/// Each published device by its row of the most samples, where the published kernel did the same work.
std::vector<Standing> published_standings(const PublishedTable& table, const std::vector<KernelWork>& works) {
    const auto own = std::find_if(works.begin(), works.end(), [&](const KernelWork& w) {
        return w.kernel == table.kernel && w.work.scene == table.scene && w.is_usual();
    });
    if (own == works.end()) return {};
    const double segments = segments_a_sample(own->entries);
    std::map<std::string, const PublishedRow*> of_device;
    for (const PublishedRow& row : table.rows) {
        const PublishedRow*& most = of_device[row.device];
        if (row.path_length == own->work.path_length && segments > 0 &&
            (most == nullptr || row.spp > most->spp))
            most = &row;
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

/// The first work that has efficiencies: of those whose truth is `base_kernel`, if there are such, else of
/// all.
const KernelWork* first_with_efficiency(const std::vector<KernelWork>& works) {
    const auto has_any = [](const KernelWork& w) {
        return !standings_of(w.entries, efficiency_of_megapixel).empty();
    };
    auto first = std::find_if(works.begin(), works.end(), [&](const KernelWork& w) {
        return truth_of(w.kernel) == base_kernel && has_any(w);
    });
    if (first == works.end()) first = std::find_if(works.begin(), works.end(), has_any);
    return first == works.end() ? nullptr : &*first;
}

void append(std::vector<Ranking>& all, Ranking ranking) {
    if (ranking.standings.empty()) return;
    std::stable_sort(ranking.standings.begin(), ranking.standings.end(),
                     [](const Standing& a, const Standing& b) { return a.value > b.value; });
    all.push_back(std::move(ranking));
}

}  // namespace

std::vector<Ranking> rankings(const std::vector<const ResultFile*>& runs, const PublishedTable& published) {
    const auto works = works_of(runs);
    const auto old = published_standings(published, works);
    std::vector<Ranking> all;
    for (const KernelWork& w : works) {
        Ranking ranking{title_of(w), rays_or_segments(w.kernel) + "/s", text_of(w.work), "",
                        standings_of(w.entries, msegments_per_s)};
        const bool as_published = w.is_usual() && (w.kernel == base_kernel || w.kernel == published.kernel);
        if (as_published && !old.empty() && !ranking.standings.empty()) {
            ranking.standings.insert(ranking.standings.end(), old.begin(), old.end());
            ranking.note = fmt::format(
                "{}: samples a second as published, times the segments that {} traces in a sample here",
                published.year, published.kernel);
        }
        append(all, ranking);
    }
    const KernelWork* first = first_with_efficiency(works);  // others of its picture are comparable to it
    for (const KernelWork& w : works)
        if (first != nullptr && w.work == first->work && truth_of(w.kernel) == truth_of(first->kernel))
            append(all, {title_of(w) + ", efficiency", "1/(relMSE s) of a megapixel", text_of(w.work), "",
                         standings_of(w.entries, efficiency_of_megapixel)});
    for (const KernelWork& w : works)
        append(all, {title_of(w) + ", per joule", rays_or_segments(w.kernel) + "/J", text_of(w.work), "",
                     standings_of(w.entries, msegments_per_joule)});
    return all;
}

}  // namespace ptb
