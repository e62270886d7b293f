#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/input/json.h"

namespace ptb {

/// One value of a document and where it stands. What is not as asked throws UsageError.
struct JsonNode {
    const Json& json;
    Where where;

    /// What is in it knows where it is by this node, which therefore has to have a name.
    JsonNode at(std::string_view key) const& {
        return {member(json, where, std::string(key)), Where(where, key)};
    }
    JsonNode at(std::size_t index) const& { return {json[index], Where(where, index)}; }
    JsonNode list(std::string_view key) const& {
        JsonNode node = at(key);
        if (!node.json.is_array()) node.refuse("a list");
        return node;
    }
    JsonNode at(std::string_view) const&& = delete;
    JsonNode at(std::size_t) const&& = delete;
    JsonNode list(std::string_view) const&& = delete;
    std::size_t size() const { return json.size(); }
    bool has(const std::string& key) const { return json.is_object() && json.contains(key); }
    [[noreturn]] void refuse(const std::string& allowed) const { where.refuse(json, allowed); }

    std::string text(const std::string& allowed) const;
    std::uint64_t integer(std::uint64_t least, std::uint64_t most) const;
};

}  // namespace ptb
