#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "bench/compare/session.h"
#include "bench/record/fields.h"

namespace ptb {

// What is read of nvbench's file; everything else is left alone. A value is a number or its text.
struct NvValue {
    double number = std::nan("");
};
struct NvDatum {
    std::string name;
    NvValue value;
};
struct NvSummary {
    std::string tag;
    std::vector<NvDatum> data;
};
struct NvState {
    std::string name, skip_reason;
    int device = 0;
    bool is_skipped = false;
    std::optional<std::vector<NvSummary>> summaries;
};
struct NvBenchmark {
    std::string name;
    std::optional<std::vector<NvState>> states;
};
struct NvDevice {
    int id = 0, sm_version = 0;
    std::string name;
};
struct NvFile {
    std::optional<std::vector<NvDevice>> devices;
    std::vector<NvBenchmark> benchmarks;
};

template <>
inline constexpr auto fields<NvDatum> = std::make_tuple(required("name", &NvDatum::name),
                                                        required("value", &NvDatum::value));
template <>
inline constexpr auto fields<NvSummary> = std::make_tuple(required("tag", &NvSummary::tag),
                                                          field("data", &NvSummary::data));
template <>
inline constexpr auto fields<NvState> = std::make_tuple(required("name", &NvState::name),
                                                        field("device", &NvState::device),
                                                        field("is_skipped", &NvState::is_skipped),
                                                        field("skip_reason", &NvState::skip_reason),
                                                        field("summaries", &NvState::summaries));
template <>
inline constexpr auto fields<NvBenchmark> = std::make_tuple(required("name", &NvBenchmark::name),
                                                            field("states", &NvBenchmark::states));
template <>
inline constexpr auto fields<NvDevice> = std::make_tuple(required("id", &NvDevice::id),
                                                         required("name", &NvDevice::name),
                                                         field("sm_version", &NvDevice::sm_version));
template <>
inline constexpr auto fields<NvFile> = std::make_tuple(required("devices", &NvFile::devices),
                                                       required("benchmarks", &NvFile::benchmarks));

void decode(const Json& json, const Where&, NvValue& value) {
    if (json.is_number()) value.number = json.get<double>();
    if (!json.is_string()) return;
    const auto& text = json.get_ref<const std::string&>();
    const auto result = Json::parse(text, nullptr, false);  // JSON's numbers do not depend on the locale
    if (result.is_number()) value.number = result.get<double>();
}

namespace {

constexpr auto mean_seconds = "nv/cold/time/gpu/mean";

/// The mean time on the device, the only time that is in the file; NaN where it is not.
double mean_ns(const NvState& state) {
    for (const NvSummary& summary : state.summaries.value_or(std::vector<NvSummary>()))
        if (summary.tag == mean_seconds)
            for (const NvDatum& datum : summary.data)
                if (datum.name == "value") return datum.value.number * 1e9;
    return std::nan("");
}

/// A state's name without "Device=4", which is a number that a machine gave.
std::string axes_of(const NvState& state) {
    const std::string device = fmt::format("Device={}", state.device);
    if (state.name == device) return "";
    return state.name.starts_with(device + " ") ? state.name.substr(device.size()) : " " + state.name;
}

SessionCase case_of(const NvFile& file, const NvBenchmark& benchmark, const NvState& state) {
    SessionCase c;
    c.device = std::to_string(state.device);
    c.name = benchmark.name + axes_of(state);
    for (const NvDevice& device : file.devices.value_or(std::vector<NvDevice>()))
        if (device.id == state.device) {
            c.device_name = device.name;
            c.fingerprint = {{"device", device.name}, {"SM", std::to_string(device.sm_version)}};
        }
    const double ns = mean_ns(state);
    if (state.is_skipped)
        c.no_time = state.skip_reason.empty() ? "skipped" : state.skip_reason;
    else if (!(ns > 0) || !std::isfinite(ns))
        c.no_time = fmt::format("no {}", mean_seconds);
    else
        c.times_ns = {ns};
    return c;
}

}  // namespace

Session nvbench_session(const Json& json, const std::string& file) {
    NvFile read;
    decode(json, Where(file), read);
    Session session{file, "", {}};
    for (const NvBenchmark& benchmark : read.benchmarks)
        for (const NvState& state : benchmark.states.value_or(std::vector<NvState>()))
            session.cases.push_back(case_of(read, benchmark, state));
    return session;
}

}  // namespace ptb
