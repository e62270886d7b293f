#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/scene/scene.h"

namespace ptb {

struct PathRay {
    Vec3 origin, direction;  ///< direction of unit length
};

/// A triangle of a scene's meshes, ready to be met.
struct Facet {
    Vec3 a, b, c;  ///< counter-clockwise seen from outside
    Vec3 normal;   ///< outwards, unit length
    int material = 0;

    double area() const { return length(cross(b - a, c - a)) / 2; }
    Vec3 centroid() const { return (a + b + c) * (1.0 / 3); }
};

struct FacetHit {
    double distance = std::numeric_limits<double>::infinity();
    int facet = -1;
    Vec3 position;
};

/// All triangles of a scene, in its order.
class Facets {
  public:
    explicit Facets(const Scene& scene);

    const Facet& operator[](int facet) const { return facets_[static_cast<std::size_t>(facet)]; }
    int count() const { return static_cast<int>(facets_.size()); }
    /// Nearest of those ahead, less two that are left out; -1 leaves out none.
    FacetHit nearest(const PathRay& ray, int left_out, int other_left_out) const;

  private:
    /// Facets that follow each other, and a box that holds them.
    struct Group {
        std::size_t begin, end;
        Vec3 low, high;
    };

    std::vector<Facet> facets_;
    std::vector<Group> groups_;
};

}  // namespace ptb
