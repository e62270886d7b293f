#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "bench/compare/evidence.h"
#include "bench/plan/config.h"
#include "bench/record/json.h"
#include "bench/report/formats/formats.h"
#include "bench/report/formats/passed.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// The axes of a state: all but the kernel, which is the benchmark. Values are text, as nvbench writes them.
std::vector<std::string> state_axes() {
    auto axes = axis_names();
    std::erase(axes, "kernel");
    return axes;
}

Json summary(const char* tag, const char* name, const char* hint, double value) {
    const Json datum = {{"name", "value"}, {"type", "float64"}, {"value", fmt::format("{}", value)}};
    return {{"tag", tag}, {"name", name}, {"hint", hint}, {"description", name}, {"data", {datum}}};
}

Json summaries(const std::vector<double>& times_ns) {
    const Moments m = moments(times_ns);
    const Json count = {{"name", "value"}, {"type", "int64"}, {"value", std::to_string(times_ns.size())}};
    return {{{"tag", "nv/cold/sample_size"},
             {"name", "Samples"},
             {"hint", "sample_size"},
             {"description", "Samples"},
             {"data", {count}}},
            summary("nv/cold/time/gpu/mean", "GPU Time", "duration", m.mean / 1e9),
            summary("nv/cold/time/gpu/stdev/relative", "Noise", "percentage", m.sd / m.mean)};
}

Json state(const Record& record, int device, const std::vector<double>& times_ns) {
    Json values = Json::array();
    std::string name = fmt::format("Device={}", device);
    for (const std::string& axis : state_axes()) {
        const std::string value = case_value(record.params, axis);
        values.push_back({{"name", axis}, {"type", "string"}, {"value", value}});
        name += fmt::format(" {}={}", axis, value);
    }
    Json json = {{"name", name}, {"device", device}, {"type_config_index", 0}, {"axis_values", values}};
    json["is_skipped"] = times_ns.empty();
    if (times_ns.empty()) json["skip_reason"] = record.reason.empty() ? "not timed" : record.reason;
    json["summaries"] = times_ns.empty() ? Json(nullptr) : summaries(times_ns);
    return json;
}

Json axes_of(const std::vector<Record>& records) {
    Json axes = Json::array();
    for (const std::string& axis : state_axes()) {
        std::vector<std::string> seen;
        Json values = Json::array();
        for (const Record& record : records) {
            const std::string value = case_value(record.params, axis);
            if (std::find(seen.begin(), seen.end(), value) != seen.end()) continue;
            seen.push_back(value);
            values.push_back({{"input_string", value}, {"description", ""}, {"value", value}});
        }
        axes.push_back({{"name", axis}, {"type", "string"}, {"flags", ""}, {"values", values}});
    }
    return axes;
}

}  // namespace

std::string nvbench(const ResultFile& result) {
    std::map<Case, std::vector<double>> times;
    for (const Passed& p : passed(result)) times[p.record.params] = p.times_ns;
    Json devices = Json::array();
    std::map<std::string, int> number;
    for (const DeviceInfo& device : result.devices) {
        const int id = static_cast<int>(number.size());
        number[device.key] = id;
        devices.push_back({{"id", id}, {"name", device_label(result, device.key)}, {"sm_version", 0}});
    }
    std::map<std::string, std::vector<Record>> kernels;
    for (const Record& record : result.cases) kernels[record.params.kernel].push_back(record);
    Json benchmarks = Json::array();
    for (const auto& [kernel, records] : kernels) {
        Json states = Json::array();
        for (const Record& record : records)
            states.push_back(state(record, number[record.params.device], times[record.params]));
        Json ids = Json::array();
        for (const auto& [key, id] : number) ids.push_back(id);
        benchmarks.push_back({{"name", kernel},
                              {"index", benchmarks.size()},
                              {"devices", ids},
                              {"axes", axes_of(records)},
                              {"states", states}});
    }
    const Json version = {{"major", 1}, {"minor", 0}, {"patch", 0}, {"string", "1.0.0"}};
    const Json meta = {{"argv", result.run.argv}, {"version", {{"json", version}}}};
    return dump_json({{"meta", meta}, {"devices", devices}, {"benchmarks", benchmarks}}, 2) + "\n";
}

}  // namespace ptb
