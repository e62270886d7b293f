#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "core/input/nearest.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr int most = std::numeric_limits<int>::max();

[[noreturn]] void refuse(const std::string& axis, const std::string& found, const std::string& allowed) {
    throw UsageError(fmt::format("{}: found \"{}\"; allowed: {}", axis, printable(found), allowed));
}

/// A positive int in plain decimal digits, and nothing else.
std::optional<int> positive(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1) return std::nullopt;
    return value;
}

struct Pair {
    int first, second;
};

/// "640x480"
std::optional<Pair> pair_of(std::string_view text) {
    const auto cross = text.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const auto first = positive(text.substr(0, cross)), second = positive(text.substr(cross + 1));
    return first && second ? std::optional(Pair{*first, *second}) : std::nullopt;
}

int integer(const std::string& axis, const std::string& text) {
    const auto value = positive(text);
    if (!value) refuse(axis, text, fmt::format("an integer from 1 to {}", most));
    return *value;
}

/// Kernels number the pixels in 32 bits.
Size size_of(const std::string& axis, const std::string& text) {
    const auto side = positive(text);
    const auto sides = side ? Pair{*side, *side} : pair_of(text).value_or(Pair{0, 0});
    const auto pixels = static_cast<std::int64_t>(sides.first) * sides.second;
    if (pixels < 1 || pixels > most)
        refuse(axis, text, fmt::format("N or WIDTHxHEIGHT, 1 to {} pixels in all", most));
    return {sides.first, sides.second};
}

WorkGroup work_group_of(const std::string& axis, const std::string& text) {
    if (text == "implicit") return {};
    if (const auto x = positive(text)) return {*x, 0};
    const auto sides = pair_of(text);
    if (!sides) refuse(axis, text, "implicit, a size like 64, or a two-dimensional size like 16x16");
    return {sides->first, sides->second};
}

int lanes_of(const std::string& axis, const std::string& text) {
    if (text == "auto") return 0;
    const auto lanes = positive(text).value_or(0);
    if (lanes != 1 && lanes != 4 && lanes != 8 && lanes != 16 && lanes != 32)
        refuse(axis, text, "auto, 1, 4, 8, 16, 32");
    return lanes;
}

int devices_of(const std::string& axis, const std::string& text) {
    if (text == "all") return 0;
    const auto count = positive(text);
    if (!count) refuse(axis, text, "a number of devices, or all");
    return *count;
}

constexpr const char* together_words[] = {"no", "gpus", "all"};

Together together_of(const std::string& axis, const std::string& text) {
    const auto* const found = std::find(std::begin(together_words), std::end(together_words), text);
    if (found == std::end(together_words))
        refuse(axis, text, fmt::format("{}", fmt::join(together_words, ", ")));
    return static_cast<Together>(found - std::begin(together_words));
}

void set_choice(Variant& variant, const VariantAxis& axis, const std::string& text) {
    const auto found = std::find(axis.values.begin(), axis.values.end(), text);
    if (found == axis.values.end()) refuse(axis.name, text, fmt::format("{}", fmt::join(axis.values, ", ")));
    axis.set(variant, static_cast<std::size_t>(found - axis.values.begin()));
}

std::string name_of(const std::string& axis, const std::string& text) {
    const bool blank = std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); });
    if (blank || printable(text) != text) refuse(axis, text, "a name of printable characters");
    return text;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& axis_help() {
    static const auto help = [] {
        std::vector<std::pair<std::string, std::string>> all = {
            {"kernel", "integrator, by its name in `ptbench list`"},
            {"scene", "a shipped scene's name, or a scene file"},
            {"size", "pixels: N (square) or WIDTHxHEIGHT"},
            {"spp", "samples per pixel"},
            {"path_length", "most segments in a path, the camera's included"},
        };
        for (const VariantAxis& axis : variant_axes())
            all.emplace_back(axis.name, fmt::format("{}: {}", axis.help, fmt::join(axis.values, ", ")));
        all.emplace_back("lanes", "rays traced together by one work-item: auto, 1, 4, 8, 16, 32");
        all.emplace_back("work_group", "implicit (the runtime chooses), N, or NxM");
        all.emplace_back("devices", "devices that make one picture, the first of their type: 1, 2, ..., all");
        all.emplace_back("together", "who works at the same time, each at its own case: no, gpus, all");
        return all;
    }();
    return help;
}

std::vector<std::string> axis_names() {
    std::vector<std::string> names;
    for (const auto& [name, help] : axis_help()) names.push_back(name);
    return names;
}

void check_axis_name(const std::string& name) {
    const auto names = axis_names();
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    if (name == "device") throw UsageError("device: is not an axis; choose devices with -d/--device");
    throw UsageError(fmt::format("axis: found \"{}\"{}; allowed: {}", printable(name),
                                 did_you_mean(name, names), fmt::join(names, ", ")));
}

Case default_case() { return {"", "pt", "thesis", {128, 128}, 10, 128, {}, 0}; }

void set_case_value(Case& c, const std::string& axis, const std::string& value) {
    check_axis_name(axis);
    if (axis == "kernel") c.kernel = name_of(axis, value);
    if (axis == "scene") c.scene = name_of(axis, value);
    if (axis == "size") c.size = size_of(axis, value);
    if (axis == "spp") c.spp = integer(axis, value);
    if (axis == "path_length") c.path_length = integer(axis, value);
    if (axis == "lanes") c.lanes = lanes_of(axis, value);
    if (axis == "work_group") c.work_group = work_group_of(axis, value);
    if (axis == "devices") c.devices = devices_of(axis, value);
    if (axis == "together") c.together = together_of(axis, value);
    for (const VariantAxis& choice : variant_axes())
        if (axis == choice.name) set_choice(c.variant, choice, value);
}

std::string case_value(const Case& c, const std::string& axis) {
    if (axis == "device") return c.device;
    if (axis == "kernel") return c.kernel;
    if (axis == "scene") return c.scene;
    if (axis == "size") return to_string(c.size);
    if (axis == "spp") return std::to_string(c.spp);
    if (axis == "path_length") return std::to_string(c.path_length);
    if (axis == "lanes") return c.lanes == 0 ? "auto" : std::to_string(c.lanes);
    if (axis == "work_group") return to_string(c.work_group);
    if (axis == "devices") return c.devices == 0 ? "all" : std::to_string(c.devices);
    if (axis == "together") return together_words[static_cast<std::size_t>(c.together)];
    for (const VariantAxis& choice : variant_axes())
        if (axis == choice.name) return choice.value_of(c.variant);
    check_axis_name(axis);
    return {};
}

std::string of_several_devices(const Case& c) {
    if (c.devices != 1) return "devices " + case_value(c, "devices");
    return c.together == Together::no ? "" : "together " + case_value(c, "together");
}

std::string to_string(WorkGroup work_group) {
    if (work_group.implicit()) return "implicit";
    if (!work_group.two_dimensional()) return std::to_string(work_group.x);
    return fmt::format("{}x{}", work_group.x, work_group.y);
}

std::string to_string(Size size) { return fmt::format("{}x{}", size.width, size.height); }

}  // namespace ptb
