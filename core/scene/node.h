#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/input/json.h"
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

/// One value of the file and where it stands.
struct Node {
    const Json& json;
    Where where;

    Node at(const std::string& key) const { return {member(json, where, key), Where(where, key)}; }
    Node at(std::size_t index) const { return {json[index], Where(where, index)}; }
    bool has(const std::string& key) const { return json.contains(key); }
    [[noreturn]] void refuse(const std::string& allowed) const { where.refuse(json, allowed); }
};

double read_number(const Node& node, const Range& range);
Vec3 read_vec3(const Node& node, const Range& range);
std::string read_string(const Node& node, const std::string& allowed);

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
