#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/render/render.h"

namespace ptb {

struct Integrator;

/// Device memory that a render asks for, and the largest single object, bytes.
struct DeviceMemory {
    std::uint64_t total = 0, largest = 0;
};

/// How work is put on a device. `thesis` has its own way, all others share the engine.
struct Machinery {
    std::string (*options)(const Integrator&, const ocl::Device&, const Scene&, const RenderJob&);
    std::string (*refusal)(const Integrator&, const ocl::Device&, const Scene&, const RenderJob&);
    DeviceMemory (*memory)(const Integrator&, const ocl::Device&, const Scene&, const RenderJob&);
    std::unique_ptr<Render> (*make)(const Integrator&, const ocl::Device&, const ocl::Program&, const Scene&,
                                    const RenderJob&);
    /// The same, of parts of an image; null where a pixel's samples follow from each other.
    std::unique_ptr<PartRender> (*make_parts)(const Integrator&, const ocl::Device&, const ocl::Program&,
                                              const Scene&, const RenderJob&) = nullptr;
};

/// One row of the registry: everything the rest of the program knows of an integrator.
struct Integrator {
    std::string id;       ///< also of its folder in kernels/, its file and its kernels: pt/pt.cl, pt_render
    std::string summary;  ///< one line for `ptbench list`
    const Machinery* machinery = nullptr;
    std::vector<int> lanes = {1, 4, 8, 16, 32};  ///< lane widths it can be built for
    bool meshes = false;                         ///< sees meshes
    bool spheres = true;                         ///< sees spheres
    bool lists_rays =
        false;  ///< its samples are rays of a list, judged one by one, and its picture is no light
    bool two_dimensional = false;  ///< its work units are pixels, so a 2-D work-group means something
    bool rays_wait = false;      ///< on GPUs rays of its paths from the camera wait for each other in a tree
    bool samples_lamps = false;  ///< asks lamps for their light
    bool only_asks = false;      ///< finds no light at matte surfaces that it cannot ask for
    bool counts_full_length = true;  ///< its film counts samples and full-length paths

    /// No path adds to two pixels, nor is a picture made of differences: the error of a pixel follows from
    /// the variance of its own samples.
    bool independent_pixels = true;
    bool joins_paths = false;  ///< joins all vertices of two paths, which it keeps for that
    bool gradients = false;    ///< its samples tell how pixels differ from their neighbours, too
    std::string truth = {};    ///< the kernel whose references and host tracer judge its films, if not itself

    std::string file() const { return id + "/" + id + ".cl"; }  ///< of kernels/
    std::string kernel(const std::string& verb) const { return id + "_" + verb; }
    /// Build options for a job.
    std::string options(const ocl::Device& device, const Scene& scene, const RenderJob& job) const {
        return machinery->options(*this, device, scene, job);
    }
    /// Why it does not do a job of this variant, which the device may be able to do, or nothing.
    std::string refusal(const ocl::Device& device, const Scene& scene, const RenderJob& job) const {
        return machinery->refusal(*this, device, scene, job);
    }
    DeviceMemory memory(const ocl::Device& device, const Scene& scene, const RenderJob& job) const {
        return machinery->memory(*this, device, scene, job);
    }
    std::unique_ptr<Render> make(const ocl::Device& device, const ocl::Program& program, const Scene& scene,
                                 const RenderJob& job) const {
        return machinery->make(*this, device, program, scene, job);
    }
    /// Whether several devices may make one image.
    bool has_parts() const { return machinery->make_parts != nullptr && !gradients; }
    /// Why they may not, or nothing.
    std::string parts_refusal() const;
    std::unique_ptr<PartRender> make_parts(const ocl::Device& device, const ocl::Program& program,
                                           const Scene& scene, const RenderJob& job) const {
        return machinery->make_parts(*this, device, program, scene, job);
    }
};

/// Efficiencies are told in multiples of this one's.
inline constexpr const char* base_kernel = "pt";

/// Every integrator, the plain one first.
const std::vector<Integrator>& integrators();

/// Their ids, in that order.
std::vector<std::string> integrator_ids();

/// Throws std::out_of_range when there is none of that id.
const Integrator& integrator(const std::string& id);

/// The kernel whose references and host tracer judge `id`, be it of this build or of another's results.
std::string truth_of(const std::string& id);

/// The device's own lane width where the integrator has it, else the integrator's first. Scenes with meshes
/// have 1 everywhere.
int default_lanes(const Integrator& integrator, const DeviceInfo& device);

/// The tree that a job's rays search, which is built unless it was the last one; null where the scene has no
/// meshes, or the integrator sees none. Throws as build_tree does.
std::shared_ptr<const Tree> tree_of(const Integrator& integrator, const ocl::Device& device,
                                    const Scene& scene, const RenderJob& job);

/// Why this device cannot do this job (the limit is named), or nothing. Known before anything is built.
std::string unsupported_reason(const Integrator& integrator, const ocl::Device& device, const Scene& scene,
                               const RenderJob& job);

}  // namespace ptb
