#pragma once

#include <cstdint>
#include <string>

#include "bench/plan/case.h"
#include "core/integrator/registry.h"

namespace ptb {

/// The work of a case on this device, whose lane width serves where the case has none. What was tuned for
/// spheres is not for meshes, which have 1.
RenderJob render_job(const Case& params, const Integrator& kernel, const DeviceInfo& device,
                     const Scene& scene, std::uint64_t seed);

/// A case resolved: its render, and what that is made from. Scene and kernel outlive it.
struct CaseJob {
    Case params;
    const Scene* scene = nullptr;
    const Integrator* kernel = nullptr;
    RenderJob work{};

    /// All that the cost of a pixel sample depends on; of `plain`, all that its worth depends on.
    std::string key() const;
    /// The same work in work-groups of the runtime's choice.
    CaseJob implicit() const;
    /// The same work launched as usual, which gives the same image.
    CaseJob plain() const;
    /// The same work on another image.
    CaseJob sized(Size size, int spp) const;
};

}  // namespace ptb
