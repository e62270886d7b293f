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
    struct Box {
        Vec3 low, high;
    };

    double margin(const Scene& scene) const;
    Box box_of_group(std::size_t group, const Vec3& margin) const;
    void meet_group(std::size_t group, const PathRay& ray, int left_out, int other_left_out,
                    FacetHit& best) const;

    std::vector<Facet> facets_;
    std::size_t groups_ = 0;  ///< of facets that follow each other
    /// Of box i the halves are 2 i and 2 i + 1; the last `groups_` boxes are those of the groups. 1 holds
    /// all.
    std::vector<Box> boxes_;
};

}  // namespace ptb
