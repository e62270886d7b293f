#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"

namespace ptb {

/// Triangles as a file or a formula has them, in coordinates of their own. Vertices in the same place are
/// one.
class Geometry {
  public:
    /// Corners counter-clockwise as seen from outside; finite.
    void add(const Vec3& a, const Vec3& b, const Vec3& c);
    void reserve(std::size_t triangles) { faces_.reserve(triangles); }

    const std::vector<Vec3>& vertices() const { return vertices_; }
    const std::vector<Face>& faces() const { return faces_; }

  private:
    std::uint32_t vertex(const Vec3& position);
    void grow();
    std::size_t slot_of(const Vec3& position) const;

    std::vector<Vec3> vertices_;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> slots_;  ///< a hash table of vertices: numbers plus one, or 0; a power of two
};

/// An edge that not as many faces pass in one direction as in the other.
struct LooseEdge {
    Vec3 from, to;
    std::ptrdiff_t forwards = 0, backwards = 0;  ///< faces
};

/// One of the edges that keep triangles from enclosing a space, or nothing when they are closed.
std::optional<LooseEdge> loose_edge(const Geometry& geometry);

/// Of closed triangles: what they enclose, less than 0 when they are wound inwards.
double signed_volume(const Geometry& geometry);

double area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace ptb
