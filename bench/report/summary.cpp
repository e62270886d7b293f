#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/record/status.h"
#include "bench/report/axes.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr std::size_t most_reasons = 3, most_shown = 80;

std::string name_of(const ResultFile& result, const Record& record) {
    const DeviceInfo device = device_of(result, record.params.device);
    return fmt::format("{} ({})", device_label(result, device.key), device.type);
}

std::string work_text(const Case& c) {
    return fmt::format("{} with {} samples per pixel at {}{}", c.kernel, c.spp, to_string(c.size),
                       unusual_text(c));
}

/// Records of one work, fastest first: that which most devices did; rather as usual, of pt, with intervals,
/// of most samples.
std::vector<Record> headline(const std::vector<Record>& records) {
    const auto rank = [](const std::vector<Record>& r) {
        const Case& c = r.front().params;
        const double samples = 1.0 * c.spp * static_cast<double>(c.size.pixels());
        const bool sure = std::all_of(
            r.begin(), r.end(), [](const Record& each) { return each.statistics->ci_low_ns.has_value(); });
        return std::tuple(r.size(), -unusual(c, other_axes()), c.kernel == "pt", sure, samples);
    };
    std::vector<Record> best;
    for (const auto& [work, same] : by_work(records))
        if (best.empty() || rank(same) > rank(best)) best = same;
    std::sort(best.begin(), best.end(), faster);
    return best;
}

std::string times_as_fast(const Record& fast, const Record& slow) {
    const Statistics &f = *fast.statistics, &s = *slow.statistics;
    const std::string ratio = fmt::format("{:.3g}", s.median_ns / f.median_ns);
    return ratio == "1" ? "as fast as" : ratio + " times as fast as";
}

/// What both medians' intervals leave open of their ratio.
std::string sureness(const Record& fast, const Record& slow) {
    const Statistics &f = *fast.statistics, &s = *slow.statistics;
    if (!f.ci_low_ns || !f.ci_high_ns || !s.ci_low_ns || !s.ci_high_ns)
        return "too few samples to say how sure that is";
    const double low = *s.ci_low_ns / *f.ci_high_ns, high = *s.ci_high_ns / *f.ci_low_ns;
    if (low <= 1) return "which their medians' 95 % intervals do not tell apart";
    return fmt::format("{:.3g} to {:.3g} by both medians' 95 % intervals", low, high);
}

/// Of a run without implicit work-groups: the fastest time of one work, of pt and of many samples if there is
/// a choice.
std::string best_work_group(const ResultFile& result) {
    std::map<Case, std::vector<Record>> works;
    for (const Record& record : result.cases) {
        if (!timed(record)) continue;
        Case c = record.params;
        c.work_group = {};
        works[c].push_back(record);
    }
    if (works.empty()) return "No case has a time.";
    const auto rank = [](const auto& work) { return std::tuple(work.first.kernel == "pt", work.first.spp); };
    const auto work = std::max_element(works.begin(), works.end(),
                                       [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    const Record& fast = *std::min_element(work->second.begin(), work->second.end(), faster);
    const std::size_t sizes = work->second.size();
    return fmt::format("{}: {} takes {} ms in work-groups of {}{}.", name_of(result, fast),
                       work_text(fast.params), number_text(ms(fast.statistics->median_ns)),
                       to_string(fast.params.work_group),
                       sizes == 1 ? "" : fmt::format(", the fastest of {} sizes", sizes));
}

std::vector<std::string> speeds(const ResultFile& result) {
    const auto records = comparable(result);
    const auto devices = headline(records);
    if (devices.empty()) return {best_work_group(result)};
    const Record& fast = devices.front();
    const std::string time =
        fmt::format("{} takes {} ms", work_text(fast.params), number_text(ms(fast.statistics->median_ns)));
    if (devices.size() == 1) {
        const std::string spread = spread_text(*fast.statistics);
        return {fmt::format("{}: {}{}.", name_of(result, fast), time,
                            spread == "-" ? "" : " (+- " + spread + " %)")};
    }
    std::vector<std::string> sentences{
        fmt::format("{} is the fastest of {} devices: {}.", name_of(result, fast), devices.size(), time)};
    for (std::size_t i = 1; i < devices.size(); ++i)
        sentences.push_back(fmt::format("That is {} {}: {}.", times_as_fast(fast, devices[i]),
                                        name_of(result, devices[i]), sureness(fast, devices[i])));
    return sentences;
}

std::string kernels(const ResultFile& result) {
    const auto records = comparable(result);
    const auto devices = headline(records);
    for (const Record& record : records) {
        Case c = record.params;
        if (devices.empty() || c.kernel != "thesis" || devices.front().params.kernel != "pt") continue;
        c.kernel = "pt";
        if (c == devices.front().params)
            return fmt::format("There pt is {} thesis: {}.", times_as_fast(devices.front(), record),
                               sureness(devices.front(), record));
    }
    return "";
}

std::string images(const ResultFile& result) {
    std::size_t judged = 0, wrong = 0;
    std::string first;
    for (const Record& record : result.cases) {
        if (!record.validation) continue;
        ++judged;
        if (record.validation->valid) continue;
        if (wrong++ == 0) first = record.validation->reason;
    }
    if (judged == 0) return "No image was judged.";
    if (wrong == 0) return fmt::format("All {} images that were judged are right.", judged);
    return fmt::format("{} of {} images are wrong: {}.", wrong, judged, first);
}

bool unsteady(const Record& record) { return record.status == Status::unstable && timed(record); }

/// How many times are not to be trusted, and why not, of the first.
std::string unstable(const ResultFile& result) {
    const auto first = std::find_if(result.cases.begin(), result.cases.end(), unsteady);
    if (first == result.cases.end()) return "";
    const auto count = std::count_if(first, result.cases.end(), unsteady);
    return fmt::format("{} of {} cases {} unstable, {} not to be trusted: {}.", count, result.cases.size(),
                       count == 1 ? "is" : "are", count == 1 ? "its time is" : "their times are",
                       first->reason);
}

std::string failures(const ResultFile& result) {
    const Grid groups = problems_section(result).grid;
    std::vector<std::string> parts;
    std::size_t cases = 0;
    for (const auto& row : groups.rows) {
        cases += std::stoul(row[1]);
        if (parts.size() < most_reasons)
            parts.push_back(fmt::format("{} {} ({})", row[1], row[0], shortened(row[2], most_shown)));
    }
    const bool steady = std::none_of(result.cases.begin(), result.cases.end(), unsteady);
    if (parts.empty())
        return fmt::format("All {} cases {}.", result.cases.size(), steady ? "ended well" : "have a time");
    if (groups.rows.size() > parts.size()) parts.emplace_back("others");
    return fmt::format("{} of {} cases have no time: {}.", cases, result.cases.size(),
                       fmt::join(parts, "; "));
}

}  // namespace

Section summary_section(const ResultFile& result) {
    Section section;
    section.title = "in short";
    if (result.cases.empty()) return section;
    section.notes = speeds(result);
    for (const std::string& sentence : {kernels(result), images(result), failures(result), unstable(result)})
        if (!sentence.empty()) section.notes.push_back(sentence);
    if (result.run.interrupted)
        section.notes.emplace_back("The run was interrupted: these are its cases until then.");
    return section;
}

}  // namespace ptb
