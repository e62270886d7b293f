#include "core/scene/json_node.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/scene/json_text.h"
#include "core/scene/nearest.h"
#include "core/scene/scene.h"

namespace ptb {

void JsonNode::fail(const std::string& reason) const {
    std::string pointer =
        nlohmann::json(pointer_.to_string()).dump(-1, ' ', true);  // escapes what is unprintable
    pointer = pointer.substr(1, pointer.size() - 2);
    if (pointer.size() > 200) pointer = pointer.substr(0, 197) + "...";
    throw SceneError(fmt::format("{}: {}: {}", origin_, pointer.empty() ? "/" : pointer, reason));
}

void JsonNode::refuse(const std::string& rule) const {
    fail(fmt::format("{} is not allowed; {}", shown(value_), rule));
}

JsonNode JsonNode::at(const std::string& key) const {
    if (!value_.is_object()) refuse("here stands an object");
    const auto found = value_.find(key);
    if (found == value_.end()) fail(fmt::format("the key \"{}\" is missing", key));
    return {*found, origin_, pointer_ / key};
}

std::vector<JsonNode> JsonNode::elements() const {
    if (!value_.is_array()) refuse("here stands an array");
    std::vector<JsonNode> nodes;
    for (std::size_t i = 0; i < value_.size(); ++i) nodes.push_back({value_[i], origin_, pointer_ / i});
    return nodes;
}

std::vector<std::string> JsonNode::keys() const {
    if (!value_.is_object()) refuse("here stands an object");
    std::vector<std::string> keys;
    for (const auto& item : value_.items()) keys.push_back(item.key());
    return keys;
}

void JsonNode::allow_only(const std::vector<std::string>& allowed, const std::string& owner) const {
    for (const std::string& key : keys()) {
        if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
        at(key).fail(fmt::format("unknown key; {} has {} (nearest: {})", owner, joined(allowed),
                                 nearest_word(key, allowed)));
    }
}

double JsonNode::number(const Range& range) const {
    if (!value_.is_number()) refuse(range.text);
    const double number = value_.get<double>();
    if (!(number >= range.least && number <= range.most)) refuse(range.text);
    return number;
}

Vec3 JsonNode::vec3(const Range& range) const {
    if (!value_.is_array() || value_.size() != 3) refuse("here stand three numbers; " + range.text);
    const std::vector<JsonNode> parts = elements();
    return {parts[0].number(range), parts[1].number(range), parts[2].number(range)};
}

std::string JsonNode::text(const std::string& rule) const {
    if (!value_.is_string()) refuse(rule);
    return value_.get<std::string>();
}

}  // namespace ptb
