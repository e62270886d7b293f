#include "core/input/json_node.h"

#include <fmt/format.h>

namespace ptb {

std::string JsonNode::text(const std::string& allowed) const {
    if (!json.is_string()) refuse(allowed);
    return json.get<std::string>();
}

std::uint64_t JsonNode::integer(std::uint64_t least, std::uint64_t most) const {
    const bool is_one = json.is_number_unsigned();
    if (!is_one || json.get<std::uint64_t>() < least || json.get<std::uint64_t>() > most)
        refuse(fmt::format("an integer from {} to {}", least, most));
    return json.get<std::uint64_t>();
}

}  // namespace ptb
