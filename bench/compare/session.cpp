#include "bench/compare/session.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/compare/row.h"
#include "bench/measure/causes.h"
#include "bench/measure/statistics.h"
#include "bench/plan/tuned.h"
#include "bench/record/cpus.h"
#include "bench/record/fingerprint.h"
#include "bench/record/journal.h"
#include "bench/record/json.h"

namespace ptb {
namespace {

/// Of one render, as the record's statistics have them.
std::vector<double> times_of(const Record& record) {
    const int renders = record.work ? record.work->renders : 1;
    auto times = keep(record.samples, record.statistics->timer == "host", renders).times_ns;
    std::erase_if(times, [](double ns) { return !(ns > 0); });
    return times;
}

/// What nobody named, and tuning chose.
std::string launch_tuned(const Case& c) { return c == as_asked(c) ? "no" : launch_text(c); }

/// What every case of the device shares.
Fingerprint surroundings(const HostInfo& host, const DeviceInfo& device) {
    Fingerprint facts{{"device", device.name},
                      {"driver", device.driver_version},
                      {"compute units", std::to_string(device.compute_units)},
                      {"CPU", host.cpu}};
    if (host.cpus_allowed == 0) return facts;
    facts.push_back({"CPUs allowed", std::to_string(host.cpus_allowed)});
    facts.push_back({"CPU quota", quota_text(host.cpu_quota)});
    return facts;
}

DeviceInfo device_of(const ResultFile& result, const std::string& key) {
    for (const DeviceInfo& each : result.devices)
        if (each.key == key) return each;
    return {};
}

SessionCase case_of(const ResultFile& result, const Record& record) {
    const DeviceInfo device = device_of(result, record.params.device);
    SessionCase c;
    c.device = record.params.device;
    c.device_name = device.name;
    c.device_uuid = device.uuid;
    c.scene_hash = scene_hash_of(result.run, record.params.scene);
    c.no_time = record.status == Status::ok ? "" : record.reason;
    if (record.efficiency && record.efficiency->all) c.efficiency = record.efficiency->all->efficiency;
    c.fingerprint = surroundings(result.host, device);
    c.fingerprint.push_back({"tuned", launch_tuned(record.params)});
    if (record.build) c.fingerprint.push_back({"kernel hash", record.build->kernel_hash});
    if (record.build) c.fingerprint.push_back({"build options", record.build->options});
    if (!record.statistics) {
        if (c.no_time.empty()) c.no_time = "validated only";
        return c;
    }
    c.fingerprint.push_back({"timer", record.statistics->timer});
    c.times_ns = times_of(record);
    c.low_n = record.statistics->stop_reason == "low_n";
    if (c.times_ns.empty() && c.no_time.empty()) c.no_time = "no sample has a time";
    return c;
}

/// Characters of a number that is not finite, at the beginning of `text`, or 0.
std::size_t not_finite(std::string_view text) {
    for (const std::string_view word : {"NaN", "-NaN", "Infinity", "-Infinity"})
        if (text.starts_with(word)) return word.size();
    return 0;
}

/// Google Benchmark writes numbers that JSON has no words for; here they are null.
std::string with_nulls(std::string_view text) {
    std::string plain;
    bool in_text = false;
    for (std::size_t i = 0; i < text.size();) {
        const auto left = text.substr(i);
        if (left[0] == '"') in_text = !in_text;
        const std::size_t escaped = in_text && left[0] == '\\' && left.size() > 1 ? 2 : 1;
        const std::size_t number = in_text ? 0 : not_finite(left);
        plain += number > 0 ? std::string_view("null") : left.substr(0, escaped);
        i += number > 0 ? number : escaped;
    }
    return plain;
}

}  // namespace

double SessionCase::median_ns() const {
    auto sorted = times_ns;
    std::sort(sorted.begin(), sorted.end());
    return quantile(sorted, 0.5);
}

Session session_of(const ResultFile& result, const std::string& file) {
    Session session{file, result.run.started_at, {}, result.run.git_sha};
    std::map<Case, int> asked;
    for (const Record& record : result.cases) ++asked[as_asked(record.params)];
    for (const Record& record : result.cases) {
        SessionCase& c = session.cases.emplace_back(case_of(result, record));
        // One series leaves open what another names: two cases, which were one without tuning.
        c.params = asked[as_asked(record.params)] > 1 ? record.params : as_asked(record.params);
        c.name = case_text(*c.params);
    }
    return session;
}

Session read_session(const std::filesystem::path& file) {
    return file == "-" ? parse_session(read_text("/dev/stdin"), "stdin")
                       : parse_session(read_text(file), file.string());
}

Session parse_session(std::string_view text, const std::string& file) {
    if (is_journal(text)) return session_of(parse_journal(text, file), file);
    const std::string plain = with_nulls(text);
    const Json json = parse_json(plain, file);
    const bool other = json.is_object() && !json.contains("schema") && json.contains("benchmarks");
    if (other && json.contains("context")) return google_benchmark_session(json, file);
    if (other && json.contains("devices")) return nvbench_session(json, file);
    return session_of(result_from_json(plain == text ? json : parse_json(text, file), file), file);
}

}  // namespace ptb
