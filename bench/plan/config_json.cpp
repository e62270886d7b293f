#include "bench/plan/config_json.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "bench/plan/limits.h"
#include "bench/plan/tolerance.h"

namespace ptb {
namespace {

void read_count(const Json& json, const Where& where, int least, int& value) {
    if (json.is_number()) decode(json, where, value);
    if (!json.is_number() || value < least || value > limits::most_repetitions)
        where.refuse(json, fmt::format("an integer from {} to {}", least, limits::most_repetitions));
}

void read_seconds(const Json& json, const Where& where, bool zero_allowed, double& value) {
    if (json.is_number()) decode(json, where, value);
    const bool good =
        json.is_number() && (value > 0 || (zero_allowed && value == 0)) && value <= limits::most_seconds;
    if (!good)
        where.refuse(json,
                     fmt::format("seconds, {}, at most 1e9", zero_allowed ? "0 or more" : "more than 0"));
}

void read_seed(const Json& json, const Where& where, std::uint64_t& value) {
    if (json.is_number_unsigned()) decode(json, where, value);
    if (!json.is_number_unsigned() || value > limits::most_seed)
        where.refuse(json, fmt::format("an integer from 0 to {}", limits::most_seed));
}

void read_timer(const Json& json, const Where& where, std::string& value) {
    if (json != "auto" && json != "event" && json != "host") where.refuse(json, "auto, event, host");
    value = json.get<std::string>();
}

void read_pictures(const Json& json, const Where& where, Pictures& value) {
    if (json != "best" && json != "equal_time") where.refuse(json, "best, equal_time");
    value = json == "best" ? Pictures::best : Pictures::equal_time;
}

/// "cpu", 0 or a list of those.
void read_devices(const Json& json, const Where& where, std::vector<std::string>& devices) {
    devices.clear();
    const Json list = json.is_array() ? json : Json::array({json});
    for (const Json& item : list) {
        const bool good =
            item.is_number_unsigned() || (item.is_string() && !item.get_ref<const std::string&>().empty());
        if (!good) where.refuse(json, "a device selector, or a list of them");
        devices.push_back(item.is_string() ? item.get<std::string>() : dump_json(item));
    }
}

void read_series(const Json& json, const Where& where, std::vector<Series>& series) {
    if (!json.is_array() || json.empty()) where.refuse(json, "a list of at least one series");
    for (const Json& item : json) series.push_back(parse_series(item, Where(where, series.size())));
}

using Reader = std::function<void(const Json&, const Where&, Config&)>;

const std::vector<std::pair<std::string, Reader>>& readers() {
    using J = const Json&;
    using W = const Where&;
    static const std::vector<std::pair<std::string, Reader>> table = {
        {"$schema", [](J, W, Config&) {}},
        {"name", [](J j, W w, Config& c) { decode(j, w, c.name); }},
        {"description", [](J j, W w, Config& c) { decode(j, w, c.description); }},
        {"device", [](J j, W w, Config& c) { read_devices(j, w, c.devices); }},
        {"warmup", [](J j, W w, Config& c) { read_count(j, w, 0, c.measure.warmup.emplace()); }},
        {"samples",
         [](J j, W w, Config& c) {
             read_count(j, w, 1, c.measure.min_samples);
             c.measure.max_samples = c.measure.min_samples;
         }},
        {"min_samples", [](J j, W w, Config& c) { read_count(j, w, 1, c.measure.min_samples); }},
        {"max_samples", [](J j, W w, Config& c) { read_count(j, w, 1, c.measure.max_samples); }},
        {"max_time", [](J j, W w, Config& c) { read_seconds(j, w, false, c.measure.max_time_s); }},
        {"max_total_time", [](J j, W w, Config& c) { read_seconds(j, w, true, c.max_total_time_s); }},
        {"timeout", [](J j, W w, Config& c) { read_seconds(j, w, false, c.timeout_s); }},
        {"seed", [](J j, W w, Config& c) { read_seed(j, w, c.measure.seed); }},
        {"tolerance", [](J j, W w, Config& c) { c.tolerance = read_tolerance(j, w); }},
        {"timer", [](J j, W w, Config& c) { read_timer(j, w, c.measure.timer); }},
        {"skip_time", [](J j, W w, Config& c) { decode(j, w, c.measure.skip_time); }},
        {"kernel_dir", [](J j, W w, Config& c) { decode(j, w, c.measure.kernel_dir); }},
        {"pictures", [](J j, W w, Config& c) { read_pictures(j, w, c.pictures); }},
        {"series", [](J j, W w, Config& c) { read_series(j, w, c.series); }},
    };
    return table;
}

void read_key(const std::string& key, const Json& json, const Where& where, Config& config) {
    std::vector<std::string> known;
    for (const auto& [name, read] : readers()) {
        if (name == key) return read(json, Where(where, key), config);
        known.push_back(name);
    }
    refuse_key(key, where, known);
}

/// The least number gives way to the most, unless it was asked for.
void check_samples(const Json& json, const Where& root, MeasureOptions& measure) {
    if (json.contains("min_samples") && measure.min_samples > measure.max_samples)
        Where(root, "min_samples")
            .refuse(measure.min_samples, fmt::format("at most max_samples, {}", measure.max_samples));
    measure.min_samples = std::min(measure.min_samples, measure.max_samples);
}

}  // namespace

Config parse_config(std::string_view json_text, const std::string& origin) {
    const Json json = parse_json(json_text, origin);
    const Where root(origin);
    if (!json.is_object()) root.refuse(json, "an object");
    Config config;
    for (const auto& [key, value] : json.items()) read_key(key, value, root, config);
    check_samples(json, root, config.measure);
    return config;
}

std::string dump_config(const Config& config) {
    Json json = Json::object();
    json["name"] = config.name;
    json["description"] = config.description;
    json["device"] = config.devices;
    if (config.measure.warmup) json["warmup"] = *config.measure.warmup;
    json["min_samples"] = config.measure.min_samples;
    json["max_samples"] = config.measure.max_samples;
    json["max_time"] = config.measure.max_time_s;
    json["max_total_time"] = config.max_total_time_s;
    if (config.tolerance) json["tolerance"] = percent_text(*config.tolerance);
    json["timeout"] = config.timeout_s;
    json["seed"] = config.measure.seed;
    json["timer"] = config.measure.timer;
    json["skip_time"] = config.measure.skip_time;
    json["kernel_dir"] = config.measure.kernel_dir;
    json["pictures"] = config.pictures == Pictures::best ? "best" : "equal_time";
    json["series"] = Json::array();
    for (const Series& series : config.series) json["series"].push_back(series_to_json(series));
    if (config.series.empty()) json.erase("series");
    return dump_json(json, 2) + "\n";
}

}  // namespace ptb
