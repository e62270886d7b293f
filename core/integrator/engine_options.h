#pragma once

#include <cstdint>
#include <string>

#include "core/integrator/device_scene.h"
#include "core/integrator/registry.h"

namespace ptb {

/// The scene with what of it the integrator asks for, as a job of this variant has it there.
DeviceScene device_scene_for(const Integrator& row, const ocl::Device& device, const Scene& scene,
                             const RenderJob& job);

/// Build options of kernels that search this tree.
std::string tree_options(const ocl::Device& device, const Tree& tree);

/// What cannot be where there are meshes, or nothing.
std::string mesh_refusal(const Integrator& row, const ocl::Device& device, const Scene& scene,
                         const RenderJob& job);

/// The tree of a scene with meshes that a job of this variant searches; null without meshes.
std::shared_ptr<const Tree> tree_for(const Integrator& row, const ocl::Device& device, const Scene& scene,
                                     const RenderJob& job);

/// Build options of an integrator for a job.
std::string engine_options(const Integrator& row, const ocl::Device& device, const Scene& scene,
                           const RenderJob& job);

/// Why it does not do a job of this variant on this device, or nothing.
std::string engine_refusal(const Integrator& row, const ocl::Device& device, const Scene& scene,
                           const RenderJob& job);

/// Of the grid of cells that stratified samples of a pixel lie in, one each: the largest divisor of spp that
/// is not above its root.
std::uint32_t strata_columns(std::uint32_t spp);

/// Rays that a sample of this length takes at most, one after the other: where pixels share paths, those of
/// two paths, and between all their vertices.
int most_rays(const Integrator& row, int path_length);

/// One that wants thousands of work-items: all but CPUs.
bool is_throughput_device(const ocl::Device& device);

}  // namespace ptb
