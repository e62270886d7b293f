#include "bench/compare/session.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/compare/row.h"
#include "bench/measure/causes.h"
#include "bench/measure/statistics.h"
#include "bench/plan/tuned.h"
#include "bench/record/json.h"

namespace ptb {
namespace {

/// Of one render, in samples without a flag, while those are at least half; by the clock that the record
/// believes.
std::vector<double> times_of(const Record& record) {
    const bool host = record.statistics->timer == "host";
    const int renders = record.work ? record.work->renders : 1;
    std::vector<double> clean, all;
    for (const TimeSample& sample : record.samples) {
        const double ns = time_ns(sample, host, renders);
        if (!(ns > 0)) continue;
        all.push_back(ns);
        if (sample.cause.empty()) clean.push_back(ns);
    }
    return 2 * clean.size() >= all.size() ? clean : all;
}

/// What nobody named, and tuning chose.
std::string launch_tuned(const Case& c) { return c == as_asked(c) ? "no" : launch_text(c); }

SessionCase case_of(const ResultFile& result, const Record& record) {
    DeviceInfo device;
    for (const DeviceInfo& each : result.devices)
        if (each.key == record.params.device) device = each;
    SessionCase c;
    c.device = record.params.device;
    c.name = case_text(as_asked(record.params));
    c.params = record.params;
    c.no_time = record.status == Status::ok ? "" : record.reason;
    c.fingerprint = {{"device", device.name},
                     {"driver", device.driver_version},
                     {"CPU", result.host.cpu},
                     {"tuned", launch_tuned(record.params)}};
    if (record.efficiency && record.efficiency->all) c.efficiency = record.efficiency->all->efficiency;
    if (record.build) c.fingerprint.emplace_back("kernel hash", record.build->kernel_hash);
    if (record.build) c.fingerprint.emplace_back("build options", record.build->options);
    if (!record.statistics) {
        if (c.no_time.empty()) c.no_time = "validated only";
        return c;
    }
    c.fingerprint.emplace_back("timer", record.statistics->timer);
    c.times_ns = times_of(record);
    c.low_n = record.statistics->stop_reason == "low_n";
    if (c.times_ns.empty() && c.no_time.empty()) c.no_time = "no sample has a time";
    return c;
}

}  // namespace

double SessionCase::median_ns() const {
    auto sorted = times_ns;
    std::sort(sorted.begin(), sorted.end());
    return quantile(sorted, 0.5);
}

Session session_of(const ResultFile& result, const std::string& file) {
    Session session{file, result.run.started_at, {}};
    std::map<Case, int> asked;
    for (const Record& record : result.cases) ++asked[as_asked(record.params)];
    for (const Record& record : result.cases) {
        SessionCase& c = session.cases.emplace_back(case_of(result, record));
        // One series leaves open what another names: two cases, which were one without tuning.
        if (asked[as_asked(record.params)] > 1) c.name = case_text(record.params);
    }
    return session;
}

Session read_session(const std::filesystem::path& file) {
    return parse_session(read_text(file), file.string());
}

Session parse_session(std::string_view text, const std::string& file) {
    const Json json = parse_json(text, file);
    const bool other = json.is_object() && !json.contains("schema") && json.contains("benchmarks");
    if (other && json.contains("context")) return google_benchmark_session(json, file);
    if (other && json.contains("devices")) return nvbench_session(json, file);
    return session_of(result_from_json(json, file), file);
}

}  // namespace ptb
