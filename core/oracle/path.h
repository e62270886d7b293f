#pragma once

#include <vector>

#include "core/oracle/facets.h"
#include "core/oracle/oracle.h"
#include "core/oracle/pixel_tally.h"
#include "core/oracle/random.h"

namespace ptb {

/// Which spheres a path is inside of. Only transmission changes it, never a computed distance: so no
/// tolerance is needed, and rounding can neither lose a path in a wall nor let it meet the surface that it
/// just left. (Of triangles the one just left is left out, and the side is where a ray comes from.)
using InsideSet = std::vector<bool>;

InsideSet spheres_around(const Scene& scene, const Vec3& point);

/// A sphere of the scene, or a triangle of its meshes.
struct Surface {
    int sphere = -1, facet = -1;
};

/// One path, from the camera on. Holds what it carries from surface to surface.
class Path {
  public:
    Path(const Scene& scene, const Facets& facets, InsideSet inside, const PathRay& ray, SplitMix64& random)
        : scene_(scene), facets_(facets), inside_(std::move(inside)), ray_(ray), random_(random) {}

    /// Goes to the nearest surface, of which the questions below are then asked. False where there is none.
    bool advance();
    /// Chooses the next direction by the surface's material, whose weight goes into the throughput.
    void scatter();

    const Material& material() const;
    const Vec3& position() const { return ray_.origin; }
    /// Unit length, on the path's side of the surface.
    Vec3 normal() const;
    const Vec3& throughput() const { return throughput_; }
    /// What the surface sends along the path to the camera.
    Vec3 emitted() const { return throughput_ * material().radiance; }
    /// No surface lies between here and a point, `lamp` left out.
    bool sees(const Vec3& point, const Surface& lamp) const;

  private:
    Vec3 outwards() const;
    bool is_inside() const;
    void pass_boundary(const Vec3& normal, double eta);

    const Scene& scene_;
    const Facets& facets_;
    InsideSet inside_;
    PathRay ray_;
    Surface surface_;  ///< that the path is on
    Vec3 throughput_ = {1, 1, 1};
    SplitMix64& random_;
};

/// Follows a path through mirrors and glass to its next matte surface, and adds what glows on the way, that
/// surface included. False where the path ends first: it left, met a lamp, or traced `path_length` segments.
bool reach_matte(Path& path, int path_length, PathSample& sample);

/// Samples every pixel of the job with paths from the camera.
OracleResult sample_paths(const Scene& scene, const OracleJob& job,
                          const std::function<PathSample(Path&)>& gather);

}  // namespace ptb
