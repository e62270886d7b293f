#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/plan/case.h"
#include "bench/record/record.h"
#include "core/input/usage_error.h"

namespace ptb {

/// One axis of a sweep and its values as text, in the words of flags and config files: {"spp", {"10",
/// "100"}}. Linked axes share one entry: names {"spp", "size"}, each point "10,1024".
struct Axis {
    std::vector<std::string> names;
    std::vector<std::vector<std::string>> points;  ///< points[i][j] belongs to names[j]
    bool operator==(const Axis&) const = default;
};

/// Axes crossed with one another. What a series does not name has its default value.
struct Series {
    std::string name;
    std::vector<Axis> axes;
    std::optional<double> tolerance;  ///< change of its cases that `compare` and `ab` let pass: 0.05
    bool operator==(const Series&) const = default;
};

/// How a case is measured; the part of a config that workers need.
struct MeasureOptions {
    std::uint64_t seed = 1;
    std::optional<int> warmup;   ///< untimed samples before the timed ones; absent: until steady
    int min_samples = 10;        ///< timed samples before a case may be precise enough
    int max_samples = 1000;      ///< timed samples of a case; never less than min_samples
    double max_time_s = 30;      ///< no further sample of a case starts after this; one is always taken
    std::string timer = "auto";  ///< "auto", "event" or "host"
    bool skip_time = false;      ///< validate only
    std::string kernel_dir;      ///< kernels from this folder instead of the embedded ones, or empty
    bool count = false;          ///< also what kernels do, by instrumented builds of them
    bool operator==(const MeasureOptions&) const = default;
};

/// Which pictures a run leaves: of each device the best one, or of each kernel and work that which took
/// nearest to the time that all kernels reach.
enum class Pictures { best, equal_time };

/// A run as configs and flags describe it.
struct Config {
    std::string name = "quick", description;
    std::vector<std::string> devices;  ///< selectors; empty means "all"
    std::vector<Series> series;
    MeasureOptions measure;
    double max_total_time_s = 0;      ///< 0: no budget
    std::optional<double> tolerance;  ///< of cases whose series has none
    double timeout_s = 120;           ///< a worker silent for longer within a case is killed
    Pictures pictures = Pictures::best;
    bool operator==(const Config&) const = default;
};

/// Parses one axis of the command line: `spp=[10,100]`, `spp=[10:100:30]`, `spp=[1:1024:x2]`, `spp=10`,
/// `(spp,size)=[(10,1024),(100,512)]`. Values are checked (`parse_case_value`). Throws UsageError.
Axis parse_axis(std::string_view text);

/// Names of the axes, in the order in which a sweep is nested (device-major), with one line of help each.
const std::vector<std::pair<std::string, std::string>>& axis_help();

std::vector<std::string> axis_names();
/// Throws UsageError, with the nearest name, unless `name` is an axis.
void check_axis_name(const std::string& name);

/// The case whose axes all have their default values; its device is empty.
Case default_case();

/// Sets one field of a case from text: size "128" or "640x480", work_group "implicit", "64", "16x16", lanes
/// "auto", 1, 4, 8, 16, rng "hash". Throws UsageError naming the axis, what was found and what is allowed.
void set_case_value(Case& c, const std::string& axis, const std::string& value);
std::string case_value(const Case& c, const std::string& axis);

/// "implicit", "64", "16x16"
std::string to_string(WorkGroup work_group);
/// "128x128"
std::string to_string(Size size);

/// The most samples per pixel that `check_case` lets pass.
int most_spp(int path_length);
/// Throws UsageError unless spp x path_length, the most segments of one pixel, fits in 32 bits.
void check_case(const Case& c);

/// Reads a config: JSON text with the same words as the flags; unknown keys are errors with a JSON pointer.
Config parse_config(std::string_view json_text, const std::string& origin);
/// `name_or_file`: a file, or the name of a config in `config_folder`. Its paths are from the file's folder,
/// or else from here. Throws UsageError listing what there is.
Config load_config(const std::string& name_or_file, const std::filesystem::path& config_folder);
/// Replaces what is a relative path in a config: scenes that do not ship, and the folder of kernels.
void move_paths(Config& config, const std::filesystem::path& config_folder,
                const std::function<std::string(const std::string&)>& moved);
/// The config as JSON that `parse_config` reads back to the same value (`--dump-config`).
std::string dump_config(const Config& config);

/// Replaces an axis in every series (or adds it): what `-a` and its sugar do.
void override_axis(Config& config, const Axis& axis);

/// Selectors one by one: "0,1" are two; a `/regex/` may hold commas.
std::vector<std::string> device_words(const std::vector<std::string>& selectors);

/// The devices that the selectors (`all`, `cpu`, `gpu`, `accelerator`, `0`, `0:1`, a key, `/regex/`, or some
/// of them between commas) name, in list order, each once, without excluded ones. Throws UsageError listing
/// the devices when one matches nothing.
std::vector<DeviceInfo> select_devices(const std::vector<std::string>& selectors,
                                       const std::vector<DeviceInfo>& devices);

/// "devices 2": why a command that measures one device at a time does not do a case, or nothing.
std::string of_several_devices(const Case& c);

/// All cases of the config on these devices: device-major, series in order, equal cases once. `tuned` serves
/// where a series leaves the launch to the program (`apply_tuned`).
std::vector<Case> expand(const Config& config, const std::vector<DeviceInfo>& devices,
                         const std::vector<Case>& tuned = {});

}  // namespace ptb
