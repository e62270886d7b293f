#pragma once

#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/input/json.h"

namespace ptb {

/// A member of a struct and its key in JSON.
template <class Struct, class Member>
struct Field {
    const char* key;
    Member Struct::*member;
    bool required;
};

/// May be absent when read (it then keeps its default), so that old files stay readable.
template <class Struct, class Member>
constexpr Field<Struct, Member> field(const char* key, Member Struct::*member) {
    return {key, member, false};
}
template <class Struct, class Member>
constexpr Field<Struct, Member> required(const char* key, Member Struct::*member) {
    return {key, member, true};
}

/// The tuple of a struct's fields: its one mapping to JSON, used to write and to read. Specialise it.
template <class Struct>
inline constexpr auto fields = nullptr;

template <class Struct>
concept HasFields = !std::same_as<std::remove_cvref_t<decltype(fields<Struct>)>, std::nullptr_t>;

template <class Value>
requires std::integral<Value> || std::same_as<Value, std::string> Json encode(const Value& value) {
    return value;
}
/// A number that is not finite has no spelling in JSON: null.
inline Json encode(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <HasFields Struct>
Json encode(const Struct& value);
template <class Value>
Json encode(const std::optional<Value>& value);
template <class Value>
Json encode(const std::vector<Value>& values);

template <HasFields Struct>
void decode(const Json& json, const Where& where, Struct& value);
template <class Value>
void decode(const Json& json, const Where& where, std::optional<Value>& value);
template <class Value>
void decode(const Json& json, const Where& where, std::vector<Value>& values);

template <class Value>
Json encode(const std::optional<Value>& value) {
    return value ? encode(*value) : Json(nullptr);
}

template <class Value>
Json encode(const std::vector<Value>& values) {
    Json json = Json::array();
    for (const Value& value : values) json.push_back(encode(value));
    return json;
}

template <HasFields Struct>
Json encode(const Struct& value) {
    Json json = Json::object();
    std::apply([&](const auto&... f) { ((json[f.key] = encode(value.*f.member)), ...); }, fields<Struct>);
    return json;
}

template <class Value>
void decode(const Json& json, const Where& where, std::optional<Value>& value) {
    if (json.is_null())
        value.reset();
    else
        decode(json, where, value.emplace());
}

template <class Value>
void decode(const Json& json, const Where& where, std::vector<Value>& values) {
    if (!json.is_array()) where.refuse(json, "a list");
    values.clear();
    for (std::size_t i = 0; i < json.size(); ++i) decode(json[i], Where(where, i), values.emplace_back());
}

template <class Struct, class Member>
void decode_field(const Json& json, const Where& where, Struct& value, const Field<Struct, Member>& f) {
    const auto found = json.find(f.key);
    if (found != json.end())
        decode(*found, Where(where, f.key), value.*f.member);
    else if (f.required)
        where.fail(std::string("\"") + f.key + "\" is missing");
}

/// Unknown keys are ignored: additions do not change a file's version.
template <HasFields Struct>
void decode(const Json& json, const Where& where, Struct& value) {
    if (!json.is_object()) where.refuse(json, "an object");
    std::apply([&](const auto&... f) { (decode_field(json, where, value, f), ...); }, fields<Struct>);
}

}  // namespace ptb
