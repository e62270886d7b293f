#include <cstdint>
#include <map>
#include <regex>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "bench/compare/session.h"
#include "bench/record/fields.h"

namespace ptb {

// What is read of a row of "benchmarks"; everything else is left alone.
struct GoogleRow {
    std::string name, run_name, run_type, aggregate_name, time_unit = "ns", error_message, skip_message;
    std::int64_t family_index = 0, per_family_instance_index = 0;
    double real_time = 0;
    bool error_occurred = false, skipped = false;
};
struct GoogleContext {
    std::string date, host_name, library_build_type;
    int num_cpus = 0;
};
struct GoogleFile {
    GoogleContext context;
    std::vector<GoogleRow> rows;
};

template <>
inline constexpr auto fields<GoogleRow> = std::make_tuple(
    required("name", &GoogleRow::name), field("run_name", &GoogleRow::run_name),
    field("run_type", &GoogleRow::run_type), field("family_index", &GoogleRow::family_index),
    field("per_family_instance_index", &GoogleRow::per_family_instance_index),
    field("aggregate_name", &GoogleRow::aggregate_name), field("skipped", &GoogleRow::skipped),
    field("skip_message", &GoogleRow::skip_message), field("real_time", &GoogleRow::real_time),
    field("time_unit", &GoogleRow::time_unit), field("error_occurred", &GoogleRow::error_occurred),
    field("error_message", &GoogleRow::error_message));
template <>
inline constexpr auto fields<GoogleContext> = std::make_tuple(field("date", &GoogleContext::date),
                                                              field("host_name", &GoogleContext::host_name),
                                                              field("num_cpus", &GoogleContext::num_cpus),
                                                              field("library_build_type",
                                                                    &GoogleContext::library_build_type));
template <>
inline constexpr auto fields<GoogleFile> = std::make_tuple(required("context", &GoogleFile::context),
                                                           required("benchmarks", &GoogleFile::rows));

namespace {

double nanoseconds(const std::string& unit, const Where& where) {
    const std::map<std::string, double> units{{"ns", 1}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}};
    const auto found = units.find(unit);
    if (found == units.end()) where.refuse(unit, "ns, us, ms, s");
    return found->second;
}

/// Before 2018 only names told aggregates from runs. One name may end by chance as an aggregate's does, but
/// those come together: mean and stddev, BigO and RMS.
void tell_old_aggregates(std::vector<GoogleRow>& rows) {
    std::map<std::string, std::set<std::string>> endings;  // by what stands before them
    const auto split = [](const GoogleRow& row) {
        static const std::set<std::string> known{"mean", "median", "stddev", "BigO", "RMS"};
        const auto end = row.name.rfind('_');
        const bool old =
            row.run_type.empty() && end != std::string::npos && known.contains(row.name.substr(end + 1));
        return old ? end : std::string::npos;
    };
    for (const GoogleRow& row : rows)
        if (const auto end = split(row); end != std::string::npos)
            endings[row.name.substr(0, end)].insert(row.name.substr(end + 1));
    for (GoogleRow& row : rows) {
        const auto end = split(row);
        if (end == std::string::npos || endings.at(row.name.substr(0, end)).size() < 2) continue;
        row.run_name = row.name.substr(0, end);
        row.run_type = "aggregate";
        row.aggregate_name = row.name.substr(end + 1);
    }
}

/// The rows of one benchmark, by their places in the file.
struct Benchmark {
    std::string name;
    std::vector<std::size_t> rows;
};

/// In the file's order. Two families may have one name; the second is then "name (2)".
std::vector<Benchmark> benchmarks_of(const std::vector<GoogleRow>& rows) {
    std::vector<Benchmark> benchmarks;
    std::map<std::tuple<std::string, std::int64_t, std::int64_t>, std::size_t> place;
    std::map<std::string, int> of_this_name;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string& name = rows[i].run_name.empty() ? rows[i].name : rows[i].run_name;
        const auto [found, is_new] = place.try_emplace(
            {name, rows[i].family_index, rows[i].per_family_instance_index}, benchmarks.size());
        if (is_new) {
            const int count = ++of_this_name[name];
            benchmarks.push_back({count == 1 ? name : fmt::format("{} ({})", name, count), {}});
        }
        benchmarks[found->second].rows.push_back(i);
    }
    return benchmarks;
}

/// The rows whose times count: repetitions are samples; where there are aggregates only, their median is the
/// one sample, or their mean where there is none. Empty for what is no benchmark: the fit of a complexity.
std::vector<std::size_t> samples_of(const Benchmark& benchmark, const std::vector<GoogleRow>& rows) {
    for (const std::string_view wanted : {"", "median", "mean"}) {
        std::vector<std::size_t> found;
        for (const std::size_t i : benchmark.rows) {
            const bool aggregate = rows[i].run_type == "aggregate";
            if (wanted.empty() ? !aggregate : aggregate && rows[i].aggregate_name == wanted)
                found.push_back(i);
        }
        if (!found.empty()) return found;
    }
    return {};
}

std::string why_no_time(const GoogleRow& row) {
    if (row.skipped) return row.skip_message.empty() ? "skipped" : row.skip_message;
    if (row.error_occurred) return row.error_message.empty() ? "it failed" : row.error_message;
    return row.real_time > 0 ? "" : "its time is not above 0";
}

/// Docker names a host after the container's id, Kubernetes after a pod: both are other ones the next time.
bool names_a_container(const std::string& host) {
    static const std::regex names(
        "[0-9a-f]{12}|[0-9a-f]{64}|.+-[bcdfghjklmnpqrstvwxz2456789]{8,10}-[bcdfghjklmnpqrstvwxz2456789]{5}");
    return std::regex_match(host, names);
}

Fingerprint fingerprint_of(const GoogleContext& context) {
    return {{"host", context.host_name, names_a_container(context.host_name)},
            {"CPUs", std::to_string(context.num_cpus)},
            {"library build", context.library_build_type}};
}

}  // namespace

Session google_benchmark_session(const Json& json, const std::string& file) {
    GoogleFile read;
    decode(json, Where(file), read);
    tell_old_aggregates(read.rows);
    Session session{file, read.context.date, {}};
    const Fingerprint fingerprint = fingerprint_of(read.context);
    const Where root(file), rows(root, "benchmarks");
    for (const Benchmark& benchmark : benchmarks_of(read.rows)) {
        const auto samples = samples_of(benchmark, read.rows);
        if (samples.empty()) continue;
        SessionCase& c = session.cases.emplace_back();
        c.name = benchmark.name;
        c.fingerprint = fingerprint;
        for (const std::size_t i : samples) {
            const Where where(rows, i);
            if (c.no_time.empty()) c.no_time = why_no_time(read.rows[i]);
            c.times_ns.push_back(read.rows[i].real_time *
                                 nanoseconds(read.rows[i].time_unit, Where(where, "time_unit")));
        }
    }
    return session;
}

}  // namespace ptb
