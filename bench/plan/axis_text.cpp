#include "bench/plan/axis_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "core/input/nearest.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr std::size_t most_points = 4096;

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Inside of `text` when it is wrapped in `open` and `close`.
bool unwrap(std::string_view& text, char open, char close) {
    if (text.size() < 2 || text.front() != open || text.back() != close) return false;
    text = trim(text.substr(1, text.size() - 2));
    return true;
}

/// Splits at commas outside of parentheses, but not at "\,"; nothing between two commas is an empty item.
std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> items;
    int depth = 0;
    std::size_t start = 0;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        const bool escaped = i > 0 && i < text.size() && text[i] == ',' && text[i - 1] == '\\';
        if (i < text.size() && text[i] == '(') ++depth;
        if (i < text.size() && text[i] == ')') --depth;
        if (i < text.size() && (text[i] != ',' || depth > 0 || escaped)) continue;
        items.emplace_back(trim(text.substr(start, i - start)));
        start = i + 1;
    }
    return items;
}

/// A value as it is meant: "a\,b" is a,b.
std::string unescaped(std::string value) {
    for (auto at = value.find("\\,"); at != std::string::npos; at = value.find("\\,", at + 1))
        value.erase(at, 1);
    return value;
}

[[noreturn]] void refuse(const std::vector<std::string>& names, std::string_view found,
                         const std::string& allowed) {
    throw UsageError(fmt::format("{}: found \"{}\"; allowed: {}", axis_key(names),
                                 printable(std::string(found)), allowed));
}

struct Range {
    std::int64_t first = 0, last = 0, step = 0;
    bool factor = false;
};

bool read_int(std::string_view text, std::int64_t& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

/// "first:last:step" or "first:last:xfactor"
Range parse_range(const std::vector<std::string>& names, std::string_view text) {
    const auto colon = text.find(':'), second = text.find(':', colon + 1);
    auto step = second == std::string_view::npos ? std::string_view() : trim(text.substr(second + 1));
    Range range;
    range.factor = step.starts_with('x');
    if (range.factor) step.remove_prefix(1);
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    const bool numbers = !step.empty() && read_int(trim(text.substr(0, colon)), range.first) &&
                         read_int(trim(text.substr(colon + 1, second - colon - 1)), range.last) &&
                         read_int(step, range.step);
    const bool ascends = range.first >= 1 && range.last >= range.first && range.last <= most &&
                         range.step >= (range.factor ? 2 : 1) && range.step <= most;
    if (!numbers || !ascends)
        refuse(names, text,
               fmt::format("FIRST:LAST:STEP or FIRST:LAST:xFACTOR, ascending integers from 1 to {}", most));
    return range;
}

void append_range(const std::vector<std::string>& names, std::string_view text,
                  std::vector<std::vector<std::string>>& points) {
    const Range range = parse_range(names, text);
    for (std::int64_t v = range.first; v <= range.last; v = range.factor ? v * range.step : v + range.step) {
        if (points.size() == most_points) refuse(names, text, fmt::format("at most {} values", most_points));
        points.push_back({std::to_string(v)});
    }
}

/// Names may hold colons; numbers with one are ranges.
bool is_range(const std::vector<std::string>& names, const std::string& item) {
    return names[0] != "kernel" && names[0] != "scene" && item.find(':') != std::string::npos;
}

std::vector<std::string> linked_point(const std::vector<std::string>& names, std::string_view text) {
    std::string_view inside = text;
    auto values = unwrap(inside, '(', ')') ? split(inside) : std::vector<std::string>();
    if (values.size() != names.size())
        refuse(names, text,
               fmt::format("points of {} values, like ({})", names.size(), fmt::join(names, ",")));
    std::transform(values.begin(), values.end(), values.begin(), unescaped);
    return values;
}

}  // namespace

std::string axis_key(const std::vector<std::string>& names) {
    return names.size() == 1 ? names[0] : fmt::format("({})", fmt::join(names, ","));
}

std::vector<std::string> parse_axis_names(std::string_view text) {
    text = trim(text);
    const bool linked = unwrap(text, '(', ')');
    auto names = linked ? split(text) : std::vector<std::string>{std::string(text)};
    for (const auto& name : names) {
        check_axis_name(name);
        if (std::count(names.begin(), names.end(), name) > 1)
            throw UsageError("axis: " + name + " is named twice");
    }
    return names;
}

std::vector<std::vector<std::string>> parse_axis_points(const std::vector<std::string>& names,
                                                        std::string_view text) {
    text = trim(text);
    const bool list = unwrap(text, '[', ']');
    if (list && text.empty()) refuse(names, "[]", "at least one value");
    std::vector<std::vector<std::string>> points;
    const auto items = split(text);
    if (!list && items.size() > 1)
        refuse(names, text, "one value, or a list in brackets; a comma in a value is \\,");
    for (const auto& item : items) {
        if (names.size() > 1)
            points.push_back(linked_point(names, item));
        else if (list && is_range(names, item))
            append_range(names, item, points);
        else
            points.push_back({unescaped(item)});
    }
    return points;
}

void check_axis(const Axis& axis) {
    if (axis.points.empty()) refuse(axis.names, "[]", "at least one value");
    Case c = default_case();
    for (const auto& point : axis.points)
        for (std::size_t i = 0; i < axis.names.size(); ++i) set_case_value(c, axis.names[i], point.at(i));
}

Axis parse_axis(std::string_view text) {
    const auto equals = text.find('=');
    if (equals == std::string_view::npos)
        throw UsageError(fmt::format("axis: found \"{}\"; allowed: NAME=VALUE or NAME=[VALUE,...]",
                                     printable(std::string(text))));
    Axis axis{parse_axis_names(text.substr(0, equals)), {}};
    axis.points = parse_axis_points(axis.names, text.substr(equals + 1));
    check_axis(axis);
    return axis;
}

}  // namespace ptb
