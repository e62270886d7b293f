#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "bench/cli/options.h"
#include "bench/plan/data_dir.h"

namespace ptb {
namespace {

/// The axes of -a, of their own flags and of variables. One that comes twice has no right value.
std::vector<Axis> axes_of(const RunFlags& flags) {
    std::vector<Axis> axes;
    for (const std::string& text : flags.axes) axes.push_back(parse_axis(text));
    for (const auto& [axis, values] : flags.axis_values) axes.push_back(axis_of_values(axis, values));
    std::set<std::string> given;
    for (const Axis& axis : axes)
        for (const std::string& name : axis.names)
            if (!given.insert(name).second)
                throw UsageError(name + ": given twice, by flags or PTBENCH_ variables; allowed: once");
    return axes;
}

void apply_devices(const RunFlags& flags, Config& config) {
    if (!flags.devices.empty()) config.devices = flags.devices;
    if (flags.all_devices) config.devices = {"all"};
}

template <class Value>
void apply(const std::optional<Value>& flag, Value& value) {
    if (flag) value = *flag;
}

/// The least number gives way to the most, unless it was asked for.
void apply_samples(const RunFlags& flags, MeasureOptions& measure) {
    apply(flags.samples, measure.min_samples);
    apply(flags.samples, measure.max_samples);
    apply(flags.min_samples, measure.min_samples);
    apply(flags.max_samples, measure.max_samples);
    if (flags.min_samples && measure.min_samples > measure.max_samples)
        throw UsageError(fmt::format("--min-samples: found {}; allowed: at most --max-samples, {}",
                                     measure.min_samples, measure.max_samples));
    measure.min_samples = std::min(measure.min_samples, measure.max_samples);
}

void apply_measuring(const RunFlags& flags, Config& config) {
    if (flags.warmup) config.measure.warmup = flags.warmup;
    apply_samples(flags, config.measure);
    apply(flags.max_time_s, config.measure.max_time_s);
    apply(flags.seed, config.measure.seed);
    apply(flags.timeout_s, config.timeout_s);
    apply(flags.max_total_time_s, config.max_total_time_s);
    if (!flags.timer.empty()) config.measure.timer = flags.timer;
    if (flags.skip_time) config.measure.skip_time = true;
}

/// A comma in the path of a file that there is separates nothing.
std::string with_commas_of_files(const std::string& axis, std::string values) {
    std::error_code ignored;
    if (axis != "scene" || !std::filesystem::is_regular_file(values, ignored)) return values;
    for (auto comma = values.find(','); comma != std::string::npos; comma = values.find(',', comma + 2))
        values.insert(comma, "\\");
    return values;
}

}  // namespace

Axis axis_of_values(const std::string& axis, const std::string& text) {
    const std::string values = with_commas_of_files(axis, text);
    const bool range =
        values.find(':') != std::string::npos && std::isdigit(static_cast<unsigned char>(values[0]));
    const bool bare_list = !values.starts_with('[') && (range || values.find(',') != std::string::npos);
    return parse_axis(axis + "=" + (bare_list ? "[" + values + "]" : values));
}

Config configured(const RunFlags& flags, const CommonFlags& common, const std::optional<Config>& earlier) {
    Config config = earlier && flags.config.empty()
                        ? *earlier
                        : load_config(flags.config.empty() ? "quick" : flags.config, data_dir() / "configs");
    apply_devices(flags, config);
    for (const Axis& axis : axes_of(flags)) override_axis(config, axis);
    apply_measuring(flags, config);
    if (!common.kernel_dir.empty()) config.measure.kernel_dir = common.kernel_dir;
    return config;
}

}  // namespace ptb
