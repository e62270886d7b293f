#include "bench/compare/history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "bench/compare/differences.h"
#include "bench/compare/evidence.h"
#include "bench/compare/match.h"
#include "bench/compare/verdict.h"
#include "bench/measure/statistics.h"
#include "core/input/usage_error.h"
#include "core/source/text_hash.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

/// What a history follows, and so may change along a line.
constexpr std::array of_version{"kernel hash", "build options"};

bool may_change(const Difference& difference) {
    return difference.may_differ ||
           std::find(of_version.begin(), of_version.end(), difference.field) != of_version.end();
}

/// What keeps two sessions' case from being of one line.
std::vector<Difference> obstacles(const SessionCase& one, const SessionCase& other) {
    auto found = differences(one, other);
    std::erase_if(found, may_change);
    return found;
}

std::string value_of(const SessionCase& c, const std::string& field) {
    for (const Fact& fact : c.fingerprint)
        if (fact.field == field) return fact.value;
    return field == "scene" ? c.scene_hash : "";
}

/// Times of one case that may be compared, in the order of the runs.
using OneLine = std::vector<const SessionCase*>;

/// Each time with the first that nothing keeps it from.
std::vector<OneLine> series_of(const Matched& m) {
    std::vector<OneLine> all;
    for (const SessionCase* const c : m.now) {
        const auto fits = [&](const OneLine& series) { return obstacles(*series.front(), *c).empty(); };
        const auto found = std::find_if(all.begin(), all.end(), fits);
        (found == all.end() ? all.emplace_back() : *found).push_back(c);
    }
    return all;
}

/// "driver 3.1, CPU EPYC": in what a series is unlike the others.
std::string where_of(const OneLine& series, const std::vector<OneLine>& all) {
    std::set<std::string> fields;
    for (const OneLine& other : all)
        for (const Difference& each : obstacles(*series.front(), *other.front())) fields.insert(each.field);
    std::vector<std::string> parts;
    for (const std::string& field : fields)
        parts.push_back(fmt::format("{} {}", field, value_of(*series.front(), field)));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::optional<Interval> interval_of(const SessionCase& c) {
    auto sorted = c.times_ns;
    std::sort(sorted.begin(), sorted.end());
    const auto found = median_interval(sorted, interval_confidence);
    return found ? std::optional(Interval{found->first, found->second}) : std::nullopt;
}

/// The session that each case is of.
using Runs = std::map<const SessionCase*, std::size_t>;

Runs runs_of(const std::vector<Session>& sessions) {
    Runs runs;
    for (std::size_t i = 0; i < sessions.size(); ++i)
        for (const SessionCase& c : sessions[i].cases) runs[&c] = i;
    return runs;
}

HistoryLine line_of(const OneLine& series, const Runs& runs) {
    const SessionCase& like = *series.front();
    HistoryLine line{like.device_name.empty() ? like.device : like.device_name, like.name, {}, 0, {}, {}};
    for (const SessionCase* const c : series)
        line.points.push_back({runs.at(c), c->median_ns(), interval_of(*c), value_of(*c, "kernel hash")});
    return line;
}

void add_lines(const Matched& m, const Runs& runs, const std::function<double(const SessionCase&)>& tolerance,
               History& history) {
    const auto all = series_of(m);
    for (const OneLine& series : all) {
        HistoryLine line = line_of(series, runs);
        line.where = where_of(series, all);
        line.tolerance = tolerance(*series.front());
        history.lines.push_back(line);
        for (const Difference& each : obstacles(*all.front().front(), *series.front()))
            history.apart.insert(each.text);
    }
}

std::vector<double> logs_of(const HistoryLine& line) {
    std::vector<double> logs;
    for (const HistoryPoint& point : line.points) logs.push_back(std::log(point.median_ns));
    return logs;
}

double least_shift(const HistoryLine& line) { return std::log1p(line.tolerance) / 2; }

/// Each line's p are corrected as Holm's method corrects its surest.
void find_steps(std::vector<HistoryLine>& lines) {
    std::vector<double> p;
    for (const HistoryLine& line : lines) p.push_back(surest_p(logs_of(line), least_shift(line)));
    const auto corrected = holm(p);
    for (std::size_t i = 0; i < lines.size(); ++i)
        lines[i].steps = steps(logs_of(lines[i]), {least_shift(lines[i]), corrected[i] / p[i]});
}

void sort_and_cut(std::vector<Session>& sessions) {
    std::stable_sort(sessions.begin(), sessions.end(), [](const Session& a, const Session& b) {
        return std::tie(a.started_at, a.file) < std::tie(b.started_at, b.file);
    });
    if (sessions.size() > most_runs)
        sessions.erase(sessions.begin(), sessions.end() - static_cast<std::ptrdiff_t>(most_runs));
}

std::vector<fs::path> json_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied))
        if (entry.is_regular_file() && entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// A reason that does not begin with a name of the file.
std::string without_name(const std::string& reason, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (reason.starts_with(name + ": ")) return reason.substr(name.size() + 2);
    return reason;
}

}  // namespace

History history_of(std::vector<Session> sessions,
                   const std::function<double(const SessionCase&)>& tolerance) {
    sort_and_cut(sessions);
    History history;
    for (const Session& each : sessions) history.runs.push_back({each.file, each.started_at, each.revision});
    const Runs runs = runs_of(sessions);
    for (const Matched& m : match({}, sessions, false)) add_lines(m, runs, tolerance, history);
    find_steps(history.lines);
    return history;
}

HistoryFolder read_history(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw UsageError(
            fmt::format("--history: found {}; allowed: a folder of result files", folder.string()));
    HistoryFolder read;
    std::map<std::string, std::string> file_of;  // by the hash of its text
    for (const fs::path& path : json_files(folder)) {
        const std::string file = path.lexically_relative(folder).string();
        try {
            const std::string text = read_text(path);
            const auto [same, is_new] = file_of.try_emplace(text_hash(text), file);
            if (!is_new) throw UsageError("the same as " + same->second);
            read.sessions.push_back(parse_session(text, file));
        } catch (const UsageError& error) {
            read.left_out.push_back({file, without_name(error.what(), {file, path.string()})});
        }
    }
    return read;
}

}  // namespace ptb
