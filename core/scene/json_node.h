#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/scene/vec3.h"

namespace ptb {

/// What a number may be; `text` says it to people: "a radius is a finite number > 0".
struct Range {
    double least, most;
    std::string text;
};

/// One value of a JSON text that remembers where it stands. Every reader throws SceneError with one line:
/// "ORIGIN: /POINTER: FOUND is not allowed; WHAT IS".
class JsonNode {
  public:
    JsonNode(const nlohmann::json& value, const std::string& origin) : value_(value), origin_(origin) {}

    bool has(const std::string& key) const { return value_.contains(key); }
    JsonNode at(const std::string& key) const;  ///< of an object; a missing key is an error
    std::vector<JsonNode> elements() const;     ///< of an array
    std::vector<std::string> keys() const;      ///< of an object
    /// An object with no other keys than these; `owner` names it in the message.
    void allow_only(const std::vector<std::string>& allowed, const std::string& owner) const;

    double number(const Range& range) const;
    Vec3 vec3(const Range& range) const;  ///< an array of three numbers
    std::string text(const std::string& rule) const;

    /// Refuses this value; `rule` says what is allowed.
    [[noreturn]] void refuse(const std::string& rule) const;
    /// Refuses for a reason in its own words.
    [[noreturn]] void fail(const std::string& reason) const;

  private:
    JsonNode(const nlohmann::json& value, const std::string& origin, nlohmann::json::json_pointer pointer)
        : value_(value), origin_(origin), pointer_(std::move(pointer)) {}

    const nlohmann::json& value_;
    const std::string& origin_;
    nlohmann::json::json_pointer pointer_;
};

}  // namespace ptb
