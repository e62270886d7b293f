#include <map>

#include <fmt/format.h>

#include "bench/compare/session.h"
#include "bench/record/fields.h"

namespace ptb {

// What is read of a row of "benchmarks"; everything else is left alone.
struct GoogleRow {
    std::string name, run_name, run_type, aggregate_name, time_unit = "ns", error_message;
    double real_time = 0;
    bool error_occurred = false;
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
    field("run_type", &GoogleRow::run_type), field("aggregate_name", &GoogleRow::aggregate_name),
    field("real_time", &GoogleRow::real_time), field("time_unit", &GoogleRow::time_unit),
    field("error_occurred", &GoogleRow::error_occurred), field("error_message", &GoogleRow::error_message));
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

/// Repetitions are samples. Where a file holds aggregates only, their median is the one sample.
bool counts(const GoogleRow& row, bool only_aggregates) {
    if (row.run_type == "aggregate") return only_aggregates && row.aggregate_name == "median";
    return true;
}

SessionCase& case_named(Session& session, const std::string& name, const GoogleContext& context) {
    for (SessionCase& c : session.cases)
        if (c.name == name) return c;
    SessionCase& c = session.cases.emplace_back();
    c.name = name;
    c.fingerprint = {{"host", context.host_name},
                     {"CPUs", std::to_string(context.num_cpus)},
                     {"library build", context.library_build_type}};
    return c;
}

}  // namespace

Session google_benchmark_session(const Json& json, const std::string& file) {
    GoogleFile read;
    decode(json, Where(file), read);
    Session session{file, read.context.date, {}};
    bool only_aggregates = true;
    for (const GoogleRow& row : read.rows) only_aggregates &= row.run_type == "aggregate";
    const Where root(file), rows(root, "benchmarks");
    for (std::size_t i = 0; i < read.rows.size(); ++i) {
        const GoogleRow& row = read.rows[i];
        if (!counts(row, only_aggregates)) continue;
        const std::string& name = row.run_name.empty() ? row.name : row.run_name;
        SessionCase& c = case_named(session, name, read.context);
        if (row.error_occurred) {
            c.no_time = row.error_message.empty() ? "it failed" : row.error_message;
            continue;
        }
        const Where where(rows, i);
        const double ns = row.real_time * nanoseconds(row.time_unit, Where(where, "time_unit"));
        if (!(ns > 0)) Where(where, "real_time").fail("allowed: a time above 0");
        c.times_ns.push_back(ns);
    }
    return session;
}

}  // namespace ptb
