#include "bench/report/axes.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

bool is_unusual(const Case& c, const std::string& axis) {
    return case_value(c, axis) != case_value(default_case(), axis);
}

bool has_a_column(const std::string& axis) {
    return axis == "kernel" || axis == "size" || axis == "spp" || axis == "work_group" || axis == "lanes";
}

}  // namespace

const std::vector<std::string>& other_axes() {
    static const std::vector<std::string> axes = [] {
        auto names = axis_names();
        std::erase_if(names, has_a_column);
        return names;
    }();
    return axes;
}

std::vector<std::string> axis_columns(const std::vector<Record>& records) {
    auto axes = varying(records, other_axes());
    for (const std::string& axis : other_axes()) {
        const bool named = axis == "scene" || axis == "path_length" ||
                           std::find(axes.begin(), axes.end(), axis) != axes.end();
        if (!named && !records.empty() && is_unusual(records.front().params, axis)) axes.push_back(axis);
    }
    return axes;
}

int unusual(const Case& c, const std::vector<std::string>& axes) {
    return static_cast<int>(
        std::count_if(axes.begin(), axes.end(), [&](const auto& axis) { return is_unusual(c, axis); }));
}

std::string unusual_text(const Case& c) {
    std::string text;
    for (const std::string& axis : other_axes())
        if (is_unusual(c, axis)) text += fmt::format(", {} {}", axis, case_value(c, axis));
    return text;
}

}  // namespace ptb
