#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/render/render.h"

namespace ptb {

/// One row of the registry: everything the rest of the program knows of an integrator.
struct Integrator {
    std::string id;
    std::string summary;      ///< one line for `ptbench list`
    std::string file;         ///< of kernels/, "pt/pt.cl"
    std::vector<int> lanes;   ///< lane widths it can be built for
    bool two_dimensional;     ///< its work units are pixels, so a 2-D work-group means something
    bool counts_full_length;  ///< its film counts samples and full-length paths
    /// Build options for a job.
    std::string (*options)(const ocl::Device& device, const Scene& scene, const RenderJob& job);
    /// Why it does not do a job of this variant, which the device may be able to do, or nothing.
    std::string (*refusal)(const ocl::Device& device, const Scene& scene, const RenderJob& job);
    /// Device memory that `make` will ask for, and the largest single buffer, in bytes.
    struct Memory {
        std::uint64_t total = 0, largest = 0;
    };
    Memory (*memory)(const ocl::Device& device, const Scene& scene, const RenderJob& job);
    std::unique_ptr<Render> (*make)(const ocl::Device& device, const ocl::Program& program,
                                    const Scene& scene, const RenderJob& job);
    /// No path adds to two pixels, so that the error of one follows from the variance of its own samples.
    bool independent_pixels = true;
};

/// Efficiencies are told in multiples of this one's.
inline constexpr const char* base_kernel = "pt";

/// Every integrator, the plain one first.
const std::vector<Integrator>& integrators();

/// Their ids, in that order.
std::vector<std::string> integrator_ids();

/// Throws std::out_of_range when there is none of that id.
const Integrator& integrator(const std::string& id);

/// The device's own lane width where the integrator has it, else the integrator's first.
int default_lanes(const Integrator& integrator, const DeviceInfo& device);

/// Why this device cannot do this job (the limit is named), or nothing. Known before anything is built.
std::string unsupported_reason(const Integrator& integrator, const ocl::Device& device, const Scene& scene,
                               const RenderJob& job);

}  // namespace ptb
