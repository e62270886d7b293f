#include <algorithm>

#include <fmt/format.h>

#include "bench/plan/axis_text.h"
#include "bench/plan/config_json.h"
#include "bench/plan/tolerance.h"

namespace ptb {
namespace {

/// A single value as text: numbers must be integers, and stay as they were written.
std::string value_text(const Json& json, const Where& where) {
    if (json.is_string()) return json.get<std::string>();
    if (json.is_number_integer()) return dump_json(json);
    where.refuse(json, "an integer or a string");
}

/// A point of linked axes: [10, 1024].
std::vector<std::string> linked_point(const Json& json, const Where& where,
                                      const std::vector<std::string>& names) {
    if (!json.is_array() || json.size() != names.size())
        where.refuse(json,
                     fmt::format("a list of {} values, one for each of {}", names.size(), axis_key(names)));
    std::vector<std::string> point;
    for (std::size_t i = 0; i < names.size(); ++i) point.push_back(value_text(json[i], Where(where, i)));
    return point;
}

std::vector<std::vector<std::string>> points_of(const Json& json, const Where& where,
                                                const std::vector<std::string>& names) {
    if (json.is_string()) return parse_axis_points(names, json.get<std::string>());
    if (json.is_number()) return {{value_text(json, where)}};
    if (!json.is_array() || json.empty()) where.refuse(json, "a value, or a list of at least one");
    std::vector<std::vector<std::string>> points;
    for (const Json& item : json) {
        const Where at(where, points.size());
        if (names.size() > 1)
            points.push_back(linked_point(item, at, names));
        else
            points.push_back({value_text(item, at)});
    }
    return points;
}

Axis parse_axis_json(const std::string& key, const Json& json, const Where& where) {
    try {
        Axis axis{parse_axis_names(key), {}};
        axis.points = points_of(json, where, axis.names);
        check_axis(axis);
        return axis;
    } catch (const UsageError& error) {
        // What already says where it is comes from below; what the axes' parsers say does not.
        if (std::string(error.what()).starts_with(where.text())) throw;
        where.fail(error.what());
    }
}

void refuse_second_axis(const Series& series, const Axis& axis, const Where& where) {
    for (const Axis& other : series.axes)
        for (const auto& name : other.names)
            if (std::find(axis.names.begin(), axis.names.end(), name) != axis.names.end())
                where.fail(name + " is an axis of this series already");
}

bool is_axis_key(const std::string& key) {
    const auto names = axis_names();
    return key.starts_with('(') || key == "device" ||
           std::find(names.begin(), names.end(), key) != names.end();
}

std::vector<std::string> series_keys() {
    auto known = axis_names();
    known.insert(known.begin(), {"name", "tolerance"});
    return known;
}

}  // namespace

double read_tolerance(const Json& json, const Where& where) {
    try {
        return parse_percent(json.is_string() ? json.get<std::string>() : dump_json(json));
    } catch (const UsageError& error) {
        where.fail(error.what());
    }
}

Series parse_series(const Json& json, const Where& where) {
    if (!json.is_object()) where.refuse(json, "an object");
    Series series;
    for (const auto& [key, value] : json.items()) {
        const Where at(where, key);
        if (key == "name") {
            decode(value, at, series.name);
        } else if (key == "tolerance") {
            series.tolerance = read_tolerance(value, at);
        } else if (is_axis_key(key)) {
            const Axis axis = parse_axis_json(key, value, at);
            refuse_second_axis(series, axis, at);
            series.axes.push_back(axis);
        } else {
            refuse_key(key, where, series_keys());
        }
    }
    return series;
}

Json series_to_json(const Series& series) {
    Json json = Json::object();
    json["name"] = series.name;
    if (series.tolerance) json["tolerance"] = percent_text(*series.tolerance);
    for (const Axis& axis : series.axes) {
        Json& points = json[axis_key(axis.names)] = Json::array();
        for (const auto& point : axis.points)
            points.push_back(axis.names.size() == 1 ? Json(point[0]) : Json(point));
    }
    return json;
}

}  // namespace ptb
