#pragma once

#include <vector>

#include "core/oracle/oracle.h"
#include "core/oracle/pixel_tally.h"
#include "core/oracle/random.h"

namespace ptb {

/// Which spheres a path is inside of. Only transmission changes it, never a computed distance: so no
/// tolerance is needed, and rounding can neither lose a path in a wall nor let it meet the surface that it
/// just left.
using InsideSet = std::vector<bool>;

InsideSet spheres_around(const Scene& scene, const Vec3& point);

struct PathRay {
    Vec3 origin, direction;  ///< direction of unit length
};

/// One path, from the camera on. Holds what it carries from surface to surface.
class Path {
  public:
    Path(const Scene& scene, InsideSet inside, const PathRay& ray, SplitMix64& random)
        : scene_(scene), inside_(std::move(inside)), ray_(ray), random_(random) {}

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
    /// No surface lies between here and a point, those of `lamp` left out.
    bool sees(const Vec3& point, int lamp) const;

  private:
    const Sphere& surface() const { return scene_.spheres[static_cast<std::size_t>(sphere_)]; }
    bool is_inside() const { return inside_[static_cast<std::size_t>(sphere_)]; }
    void pass_boundary(const Vec3& normal, double eta);

    const Scene& scene_;
    InsideSet inside_;
    PathRay ray_;
    int sphere_ = -1;
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
