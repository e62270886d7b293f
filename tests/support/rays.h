#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/integrator/device_meshes.h"
#include "core/ocl/program.h"
#include "core/render/render.h"
#include "core/tree/tree.h"
#include "shared/rays.h"

namespace ptb {

/// A tree on a device, to be met by lists of rays: kernels/rays/rays.cl. Throws what goes wrong.
class RayList {
  public:
    /// @param more_options  of the build
    /// @param kernel_dir  of other kernels than the embedded ones
    RayList(const ocl::Device& device, const Tree& tree, const std::string& more_options = "",
            const std::string& kernel_dir = "");

    /// What each ray meets; `any`: up to the first triangle within its reach.
    std::vector<ListedHit> met(std::span<const ListedRay> rays, bool any = false);
    /// The same in three steps, of which `meet` may be repeated.
    void ask(std::span<const ListedRay> rays);
    LaunchTimes meet(bool any = false);
    std::vector<ListedHit> answers() const;
    /// In an instrumented build: what the rays since the last call took.
    std::optional<Counts> counts();

  private:
    ocl::Device device_;
    ocl::Program program_;
    CountedRows counted_;
    std::vector<cl::Buffer> tree_;  ///< nodes and leaves
    TreeGrid grid_;
    cl::Buffer asked_, answers_;
    cl_uint count_ = 0;
};

/// A ray of length 1 that starts at no triangle.
ListedRay make_ray(const std::array<double, 3>& origin, const std::array<double, 3>& direction);

}  // namespace ptb
