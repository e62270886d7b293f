#include "bench/record/json.h"

#include <utility>

#include <fmt/format.h>

#include "bench/record/status.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr const char* schema = "ptbench.v1";
constexpr const char* tune = "tune";
constexpr std::pair<const char*, bool Case::*> origins[] = {{"lanes_from", &Case::lanes_tuned},
                                                            {"work_group_from", &Case::work_group_tuned}};
constexpr const char* integer_axes[] = {"spp", "path_length"};

bool is_integer_axis(const std::string& axis) {
    for (const char* name : integer_axes)
        if (axis == name) return true;
    return false;
}

const Json& member(const Json& json, const Where& where, const char* key) {
    const auto found = json.find(key);
    if (found == json.end()) where.fail(fmt::format("\"{}\" is missing", key));
    return *found;
}

/// The text of an axis' value, whatever its type in JSON.
std::string axis_text(const Json& json, const Where& where, const std::string& axis) {
    if (!is_integer_axis(axis)) {
        std::string text;
        decode(json, where, text);
        return text;
    }
    int number = 0;
    decode(json, where, number);
    return std::to_string(number);
}

/// Refuses files that a newer ptbench wrote, and those that are something else.
void check_schema(const Json& json, const std::string& origin) {
    const auto found = json.is_object() ? json.find("schema") : json.end();
    const bool named = json.is_object() && found != json.end() && found->is_string();
    const auto name = named ? found->get<std::string>() : std::string();
    if (name == schema) return;
    if (name.starts_with("ptbench.v"))
        throw UsageError(
            fmt::format("{}: schema {} is not known here; this ptbench reads {}: use the one that wrote it",
                        origin, shortened(printable(name), 40), schema));
    throw UsageError(fmt::format("{}: not a result of ptbench: \"schema\" is not \"{}\"", origin, schema));
}

}  // namespace

Json encode(const Case& c) {
    Json json = Json::object();
    json["device"] = c.device;
    for (const auto& axis : axis_names()) {
        if (axis == "spp")
            json[axis] = c.spp;
        else if (axis == "path_length")
            json[axis] = c.path_length;
        else
            json[axis] = case_value(c, axis);
    }
    for (const auto& [key, from_tune] : origins)
        if (c.*from_tune) json[key] = tune;
    return json;
}

void decode(const Json& json, const Where& where, Case& c) {
    if (!json.is_object()) where.refuse(json, "an object");
    decode(member(json, where, "device"), Where(where, "device"), c.device);
    for (const auto& axis : axis_names()) {
        // Files of earlier versions lack these: their value is the default.
        const bool is_later = is_variant_axis(axis) || axis == "devices" || axis == "together";
        if (is_later && !json.contains(axis)) continue;
        const Where at(where, axis);
        const auto text = axis_text(member(json, where, axis.c_str()), at, axis);
        try {
            set_case_value(c, axis, text);
        } catch (const UsageError& error) {
            at.fail(error.what());
        }
    }
    for (const auto& [key, from_tune] : origins) {
        c.*from_tune = json.contains(key);
        if (c.*from_tune && json[key] != tune) Where(where, key).refuse(json[key], tune);
    }
}

Json encode(Size size) { return to_string(size); }

void decode(const Json& json, const Where& where, Size& size) {
    std::string text;
    decode(json, where, text);
    Case c;
    try {
        set_case_value(c, "size", text);
    } catch (const UsageError& error) {
        where.fail(error.what());
    }
    size = c.size;
}

Json encode(const JsonText& text) {
    return text.json.empty() ? Json(nullptr) : parse_json(text.json, "document");
}

void decode(const Json& json, const Where& where, JsonText& text) {
    if (!json.is_object() && !json.is_null()) where.refuse(json, "an object");
    text.json = json.is_null() ? "" : dump_json(json);
}

Json encode(Status status) { return to_string(status); }

void decode(const Json& json, const Where& where, Status& status) {
    const auto parsed = json.is_string() ? parse_status(json.get_ref<const std::string&>()) : std::nullopt;
    if (!parsed)
        where.refuse(json, "ok, invalid, unsupported, skipped, compile, runtime, timeout, crash, unstable");
    status = *parsed;
}

template Json encode(const DeviceInfo& value);
template Json encode(const DevicePeaks& value);
template Json encode(const Record& value);
template Json encode(const ResultFile& value);
template Json encode(const RunInfo& value);
template void decode(const Json& json, const Where& where, DeviceInfo& value);
template void decode(const Json& json, const Where& where, DevicePeaks& value);
template void decode(const Json& json, const Where& where, Record& value);
template void decode(const Json& json, const Where& where, ResultFile& value);
template void decode(const Json& json, const Where& where, RunInfo& value);

Json result_to_json(const ResultFile& result) {
    Json json = Json::object();
    json["schema"] = schema;
    json.update(encode(result));
    return json;
}

ResultFile result_from_json(const Json& json, const std::string& origin) {
    check_schema(json, origin);
    ResultFile result;
    decode(json, Where(origin), result);
    return result;
}

}  // namespace ptb
