#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/oracle/facet_tree.h"
#include "core/scene/scene.h"

namespace ptb {

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
std::vector<Facet> facets_of(const Scene& scene);

/// Those, to be met by rays. Of triangles at equal distances the first one is met.
class Facets {
  public:
    explicit Facets(const Scene& scene);

    const Facet& operator[](int facet) const { return facets_[static_cast<std::size_t>(facet)]; }
    int count() const { return static_cast<int>(facets_.size()); }
    /// Nearest of those ahead, less two that are left out; -1 leaves out none.
    FacetHit nearest(const PathRay& ray, int left_out, int other_left_out) const;
    /// The same by asking each of them: what `nearest` is held against.
    FacetHit nearest_of_each(const PathRay& ray, int left_out, int other_left_out) const;

  private:
    std::vector<Facet> facets_;
    FacetTree tree_;
};

}  // namespace ptb
