#pragma once

#include <cstdint>
#include <string>

#include "core/input/json.h"

namespace ptb {

/// One value of a document and where it stands. What is not as asked throws UsageError.
struct JsonNode {
    const Json& json;
    Where where;

    JsonNode at(const std::string& key) const { return {member(json, where, key), Where(where, key)}; }
    JsonNode at(std::size_t index) const { return {json[index], Where(where, index)}; }
    bool has(const std::string& key) const { return json.is_object() && json.contains(key); }
    [[noreturn]] void refuse(const std::string& allowed) const { where.refuse(json, allowed); }

    std::string text(const std::string& allowed) const;
    std::uint64_t integer(std::uint64_t least, std::uint64_t most) const;
};

}  // namespace ptb
