#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/input/json_node.h"
#include "core/scene/scene.h"

/// How the readers of a scene's parts read and refuse.
namespace ptb::scene_json {

/// What a number may be; `text` says it to people.
struct Range {
    double least, most;
    std::string text;
};

// The largest length, so that its square still fits the devices' single precision.
inline constexpr double largest = 1e18;
inline const Range coordinate_range = {-largest, largest, "a finite number, at most 1e18 from zero"};

using Node = JsonNode;

double read_number(const Node& node, const Range& range);
Vec3 read_vec3(const Node& node, const Range& range);

/// The scene's materials by name.
class MaterialIndex {
  public:
    /// Keeps a reference.
    explicit MaterialIndex(const std::vector<Material>& materials);
    /// Index of the material that the node names.
    int read(const Node& node) const;
    const Material& operator[](int material) const { return materials_[static_cast<std::size_t>(material)]; }

  private:
    const std::vector<Material>& materials_;
    std::map<std::string, int> index_;
};

}  // namespace ptb::scene_json
