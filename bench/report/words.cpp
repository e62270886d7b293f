#include "bench/report/words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/plan/tuned.h"

namespace ptb {

std::string number_text(double value) {
    const double size = std::abs(value);
    if (!std::isfinite(value)) return "-";
    if (size >= 1000 || value == 0) return fmt::format("{:.0f}", value);
    if (size >= 100) return fmt::format("{:.1f}", value);
    if (size >= 10) return fmt::format("{:.2f}", value);
    if (size >= 0.01) return fmt::format("{:.3f}", value);
    return fmt::format("{:.2g}", value);
}

double ms(double ns) { return ns / 1e6; }

std::string TimeUnit::title(const std::string& what) const { return what + " " + name; }

std::string TimeUnit::text(double time_ns) const { return number_text(time_ns / ns); }

TimeUnit unit_of(const std::vector<Record>& records) {
    double least = std::numeric_limits<double>::infinity();
    for (const Record& record : records) least = std::min(least, record.statistics->median_ns);
    for (const TimeUnit& unit : {TimeUnit{"s", 1e9}, TimeUnit{"ms", 1e6}})
        if (std::isfinite(least) && least >= unit.ns) return unit;
    return std::isfinite(least) ? TimeUnit{"us", 1e3} : TimeUnit{};
}

std::string spread_text(const Statistics& s) {
    const auto percent = [&](double ns) { return fmt::format("{:.1f}", 100 * ns / s.median_ns); };
    if (!std::isfinite(s.median_ns) || s.median_ns <= 0) return "-";
    if (s.ci_low_ns && s.ci_high_ns) return percent((*s.ci_high_ns - *s.ci_low_ns) / 2);
    return s.n >= 3 && std::isfinite(s.mad_ns) ? fmt::format("~{}", percent(s.mad_ns)) : "-";
}

std::string mark_text(const Record& record, const Statistics& fastest) {
    const Statistics& s = *record.statistics;
    if (s.median_ns == fastest.median_ns) return "fastest";
    const bool known = record.status == Status::ok && s.ci_low_ns && fastest.ci_high_ns;
    return known && *s.ci_low_ns <= *fastest.ci_high_ns ? "as fast" : "";
}

DeviceInfo device_of(const ResultFile& result, const std::string& key) {
    for (const DeviceInfo& device : result.devices)
        if (device.key == key) return device;
    DeviceInfo unknown;
    unknown.key = unknown.name = key;
    return unknown;
}

std::string vendor_name(const DeviceInfo& device) {
    const std::pair<const char*, const char*> names[] = {{"NVIDIA", "NVIDIA"},
                                                         {"Advanced Micro Devices", "AMD"},
                                                         {"AuthenticAMD", "AMD"},
                                                         {"GenuineIntel", "Intel"},
                                                         {"Intel", "Intel"}};
    for (const auto& [part, name] : names)
        if (device.vendor.find(part) != std::string::npos) return name;
    return device.vendor;
}

std::string device_label(const ResultFile& result, const std::string& key) {
    const DeviceInfo device = device_of(result, key);
    const auto same = std::count_if(
        result.devices.begin(), result.devices.end(),
        [&](const DeviceInfo& other) { return other.name == device.name && other.excluded.empty(); });
    return same > 1 ? fmt::format("[{}] {}", key, device.name) : device.name;
}

bool timed(const Record& record) {
    const bool measured = record.status == Status::ok || record.status == Status::unstable;
    return measured && record.statistics && std::isfinite(record.statistics->median_ns);
}

bool faster(const Record& a, const Record& b) { return a.statistics->median_ns < b.statistics->median_ns; }

std::vector<Record> comparable(const ResultFile& result) {
    std::vector<Record> records;
    for (Record record : result.cases) {
        record.params = as_asked(record.params);
        if (timed(record) && record.params.work_group.implicit()) records.push_back(record);
    }
    return records;
}

std::map<Case, std::vector<Record>> by_work(const std::vector<Record>& records) {
    std::map<Case, std::vector<Record>> works;
    for (const Record& record : records) works[without_device(record.params)].push_back(record);
    return works;
}

Case without_device(Case c) {
    c.device.clear();
    return c;
}

std::vector<std::string> varying(const std::vector<Record>& records, const std::vector<std::string>& axes) {
    std::vector<std::string> result;
    for (const auto& axis : axes) {
        std::set<std::string> values;
        for (const Record& record : records) values.insert(case_value(record.params, axis));
        if (values.size() > 1) result.push_back(axis);
    }
    return result;
}

}  // namespace ptb
