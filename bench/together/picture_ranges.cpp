#include "bench/together/picture_ranges.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/record/json.h"
#include "bench/record/parts_json.h"
#include "core/input/usage_error.h"

namespace ptb {
namespace {

constexpr const char* ranges_schema = "ptbench.ranges.v1";

Json facts_json(const RunFingerprint& facts) {
    Json json = Json::object();
    for (const auto& [name, value] : facts) json[name] = value;
    return json;
}

void decode_facts(const Json& json, const Where& where, RunFingerprint& facts) {
    if (!json.is_object()) where.refuse(json, "an object");
    for (const auto& [name, value] : json.items()) decode(value, Where(where, name), facts[name]);
}

}  // namespace

template <>
inline constexpr auto fields<DeviceParts> =
    std::make_tuple(required("device", &DeviceParts::device), required("name", &DeviceParts::name),
                    field("driver_version", &DeviceParts::driver_version),
                    required("parts", &DeviceParts::parts), field("busy_s", &DeviceParts::busy_s));

std::uint64_t parts_made(const std::vector<DeviceParts>& by) {
    std::uint64_t made = 0;
    for (const DeviceParts& each : by) made += each.count();
    return made;
}

std::string fault_of(const PictureRanges& ranges) {
    std::vector<PartRange> all;
    for (const DeviceParts& device : ranges.devices)
        all.insert(all.end(), device.parts.begin(), device.parts.end());
    std::sort(all.begin(), all.end());
    std::uint64_t next = 0;
    for (const PartRange& range : all) {
        if (range.first >= range.end) return fmt::format("found a range of no part, at {}", range.first);
        if (range.first < next) return fmt::format("part {} is there twice", range.first);
        if (range.first > next) return fmt::format("part {} is missing", next);
        next = range.end;
    }
    return next == ranges.part_count ? "" : fmt::format("found {} parts of {}", next, ranges.part_count);
}

std::string to_text(const PictureRanges& ranges) {
    const Json json{{"schema", ranges_schema},
                    {"params", encode(ranges.params)},
                    {"seed", ranges.seed},
                    {"scene_hash", ranges.scene_hash},
                    {"facts", facts_json(ranges.facts)},
                    {"cut", encode(ranges.cut)},
                    {"part_count", ranges.part_count},
                    {"film_hash", ranges.film_hash},
                    {"devices", encode(ranges.devices)}};
    return dump_json(json);
}

PictureRanges parse_picture_plan(const std::string& text, const std::string& origin) {
    const Json json = parse_json(text, origin);
    const Where where(origin);
    const auto schema = json.is_object() ? json.find("schema") : json.end();
    if (!json.is_object() || schema == json.end() || *schema != ranges_schema)
        throw UsageError(fmt::format("{}: \"schema\" is not \"{}\"", origin, ranges_schema));
    PictureRanges ranges;
    const auto read = [&](const char* key, auto& value) {
        decode(member(json, where, key), Where(where, key), value);
    };
    read("params", ranges.params);
    read("seed", ranges.seed);
    read("scene_hash", ranges.scene_hash);
    decode_facts(member(json, where, "facts"), Where(where, "facts"), ranges.facts);
    if (!ranges.facts.contains("kernel " + ranges.params.kernel))
        throw UsageError(fmt::format("{}: /facts: there is no \"kernel {}\", which made the picture", origin,
                                     ranges.params.kernel));
    read("cut", ranges.cut);
    read("part_count", ranges.part_count);
    read("film_hash", ranges.film_hash);
    read("devices", ranges.devices);
    return ranges;
}

PictureRanges parse_picture_ranges(const std::string& text, const std::string& origin) {
    PictureRanges ranges = parse_picture_plan(text, origin);
    const std::string fault = fault_of(ranges);
    if (!fault.empty()) throw UsageError(fmt::format("{}: /devices: {}", origin, fault));
    return ranges;
}

}  // namespace ptb
