#include "core/scene/node.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/input/printable.h"

namespace ptb::scene_json {

double read_number(const Node& node, const Range& range) {
    const double number = node.json.is_number() ? node.json.get<double>() : NAN;
    if (!(number >= range.least && number <= range.most)) node.refuse(range.text);
    return number;
}

Vec3 read_vec3(const Node& node, const Range& range) {
    if (!node.json.is_array() || node.json.size() != 3) node.refuse("three numbers; " + range.text);
    std::array<double, 3> parts{};
    for (std::size_t i = 0; i < 3; ++i) parts[i] = read_number(node.at(i), range);
    return {parts[0], parts[1], parts[2]};
}

MaterialIndex::MaterialIndex(const std::vector<Material>& materials) : materials_(materials) {
    for (const Material& material : materials) index_.emplace(material.name, static_cast<int>(index_.size()));
}

int MaterialIndex::read(const Node& node) const {
    const auto found = index_.find(node.text("the name of a material"));
    if (found != index_.end()) return found->second;
    std::vector<std::string> names;
    for (const Material& material : materials_) names.push_back(material.name);
    node.refuse(fmt::format("one of the scene's materials: {}",
                            shortened(printable(fmt::format("{}", fmt::join(names, ", "))), 500)));
}

}  // namespace ptb::scene_json
