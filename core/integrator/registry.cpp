#include "core/integrator/registry.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/integrator/engine.h"
#include "core/integrator/engine_options.h"
#include "core/integrator/rays.h"
#include "core/integrator/thesis.h"
#include "core/integrator/variant_support.h"

namespace ptb {

namespace {

std::string memory_reason(const Integrator& integrator, const ocl::Device& device, const Scene& scene,
                          const RenderJob& job) {
    const auto [total, largest] = integrator.memory(device, scene, job);
    const auto mib = [](std::uint64_t bytes) { return static_cast<double>(bytes) / (1024.0 * 1024.0); };
    std::string what = fmt::format("size {}x{}", job.size.width, job.size.height);
    if (!scene.meshes.empty())
        what += fmt::format(" of scene {}, {} triangles,", scene.name, triangle_count(scene));
    if (total > device.info.global_bytes)
        return fmt::format("{} needs {:.0f} MiB of device memory, this device has {:.0f} MiB", what,
                           mib(total), mib(device.info.global_bytes));
    if (largest > device.info.max_alloc_bytes)
        return fmt::format("{} needs a buffer of {:.0f} MiB, this device allows {:.0f} MiB at once", what,
                           mib(largest), mib(device.info.max_alloc_bytes));
    return "";
}

std::string work_group_reason(const Integrator& integrator, const DeviceInfo& info, const RenderJob& job) {
    if (job.work_group_x == 0) return "";
    if (job.work_group_y != 0 && !integrator.two_dimensional)
        return fmt::format("work_group {}x{}: the work units of {} are one-dimensional", job.work_group_x,
                           job.work_group_y, integrator.id);
    const std::uint64_t x = static_cast<std::uint64_t>(job.work_group_x);
    const std::uint64_t y = static_cast<std::uint64_t>(std::max(job.work_group_y, 1));
    if (x * y > info.max_work_group)
        return fmt::format("work_group of {} work-items, this device allows {}", x * y, info.max_work_group);
    const auto& sizes = info.max_work_item_sizes;
    if ((!sizes.empty() && x > sizes[0]) || (sizes.size() > 1 && y > sizes[1]))
        return fmt::format("work_group {}x{}, this device allows {} by dimension", x, y,
                           fmt::join(sizes, "x"));
    return "";
}

std::string tree_reason(const Scene& scene, const Variant& variant) {
    if (!scene.meshes.empty()) return "";
    for (const char* axis : {"bvh", "bvh_split"})
        if (variant_value(axis, variant) != variant_value(axis, {}))
            return fmt::format("{} {}: scene {} has no meshes", axis, variant_value(axis, variant),
                               scene.name);
    return "";
}

std::string reconstruction_reason(const Integrator& integrator, const Variant& variant) {
    if (integrator.gradients || variant.reconstruction == Reconstruction{}) return "";
    return fmt::format("reconstruction {}: {} has no gradients", variant_value("reconstruction", variant),
                       integrator.id);
}

std::string ray_kind_reason(const Integrator& integrator, const Variant& variant) {
    if (integrator.lists_rays || variant.ray_kind == RayKind{}) return "";
    return fmt::format("ray_kind {}: {} lists no rays", variant_value("ray_kind", variant), integrator.id);
}

std::string aov_reason(const Integrator& integrator, const Scene& scene, const RenderJob& job) {
    if (is_of_gradients(job.aov) && !integrator.gradients)
        return fmt::format("aov {}: {} has no gradients", aov_names[static_cast<std::size_t>(job.aov)],
                           integrator.id);
    if (job.aov != Aov::cost) return "";
    if (scene.meshes.empty())
        return fmt::format("aov cost: scene {} has no meshes, whose tree it shows", scene.name);
    if (integrator.lists_rays)
        return fmt::format("aov cost: {} shows where rays end; --peaks counts what they take", integrator.id);
    if (integrator.independent_pixels) return "";
    return fmt::format("aov cost: samples of {} belong to no pixel alone", integrator.id);
}

}  // namespace

const std::vector<Integrator>& integrators() {
    static const std::vector<Integrator> all{
        {.id = "thesis",
         .summary = "the 2016 thesis' algorithm, its habits and defects kept: the throughput baseline",
         .machinery = &thesis_machinery,
         .lanes = {1},
         .two_dimensional = true,
         .counts_full_length = false},
        {.id = "whitted",
         .summary = "classical ray tracing: mirrors and glass, hard shadows from one point of each lamp",
         .machinery = &engine_machinery,
         .meshes = true,
         .samples_lamps = true},
        {.id = "direct",
         .summary = "ray tracing with lamps as areas: soft shadows, no light from matte to matte",
         .machinery = &engine_machinery,
         .meshes = true,
         .rays_wait = true,
         .samples_lamps = true,
         .only_asks = true},
        {.id = "pt",
         .summary = "physically right path tracer: no next-event estimation",
         .machinery = &engine_machinery,
         .meshes = true,
         .rays_wait = true},
        {.id = "pt_nee",
         .summary = "pt with next-event estimation: lamps are asked for their light at matte surfaces",
         .machinery = &engine_machinery,
         .meshes = true,
         .rays_wait = true,
         .samples_lamps = true,
         .truth = "pt"},
        {.id = "pt_lt",
         .summary = "pt_nee with light tracing: caustics are shown to the camera by paths from lamps",
         .machinery = &engine_machinery,
         .meshes = true,
         .rays_wait = true,
         .samples_lamps = true,
         .independent_pixels = false,
         .truth = "pt"},
        {.id = "bdpt",
         .summary = "bidirectional path tracing: paths from lamps and from the camera, joined in all ways",
         .machinery = &engine_machinery,
         .meshes = true,
         .samples_lamps = true,
         .independent_pixels = false,
         .joins_paths = true,
         .truth = "pt"},
        {.id = "gpt",
         .summary =
             "gradient-domain pt_nee: samples also tell how pixels differ, and a picture is made of both",
         .machinery = &engine_machinery,
         .samples_lamps = true,
         .independent_pixels = false,
         .gradients = true,
         .truth = "pt"},
        {.id = "gbdpt",
         .summary =
             "gradient-domain bdpt: samples also tell how pixels differ, and a picture is made of both",
         .machinery = &engine_machinery,
         .samples_lamps = true,
         .independent_pixels = false,
         .joins_paths = true,
         .gradients = true,
         .truth = "pt"},
        {.id = "rays",
         .summary = "lists of rays of one kind, met with the tree of a scene's meshes: no light",
         .machinery = &rays_machinery,
         .lanes = {1},
         .meshes = true,
         .spheres = false,
         .lists_rays = true,
         .counts_full_length = false},
    };
    return all;
}

std::string Integrator::parts_refusal() const {
    if (has_parts()) return "";
    return fmt::format("kernel {}: several devices cannot share its pictures, since {}", id,
                       gradients    ? "they are made of all differences between pixels"
                       : lists_rays ? "they are of lists of rays"
                                    : "a pixel's samples follow from each other");
}

std::vector<std::string> integrator_ids() {
    std::vector<std::string> ids;
    for (const Integrator& row : integrators()) ids.push_back(row.id);
    return ids;
}

const Integrator& integrator(const std::string& id) {
    for (const Integrator& row : integrators())
        if (row.id == id) return row;
    throw std::out_of_range(fmt::format("no kernel \"{}\"", id));
}

std::string truth_of(const std::string& id) {
    for (const Integrator& row : integrators())
        if (row.id == id && !row.truth.empty()) return row.truth;
    return id;
}

int default_lanes(const Integrator& integrator, const DeviceInfo& device) {
    const auto& widths = integrator.lanes;
    const bool has = std::find(widths.begin(), widths.end(), device.default_lanes) != widths.end();
    return has ? device.default_lanes : widths.front();
}

std::shared_ptr<const Tree> tree_of(const Integrator& integrator, const ocl::Device& device,
                                    const Scene& scene, const RenderJob& job) {
    return integrator.meshes ? tree_for(integrator, device, scene, job) : nullptr;
}

std::string unsupported_reason(const Integrator& integrator, const ocl::Device& device, const Scene& scene,
                               const RenderJob& job) {
    if (std::find(integrator.lanes.begin(), integrator.lanes.end(), job.lanes) == integrator.lanes.end())
        return fmt::format("lanes {}: {} has {}", job.lanes, integrator.id,
                           fmt::join(integrator.lanes, ", "));
    if (!scene.meshes.empty() && !integrator.meshes)
        return fmt::format("scene {} has meshes: {} sees spheres alone", scene.name, integrator.id);
    if (scene.meshes.empty() && !integrator.spheres)
        return fmt::format("scene {} has no meshes: {} meets triangles alone", scene.name, integrator.id);
    if (paths_per_item(device, scene, most_rays(integrator, job.path_length)) == 0)
        return fmt::format("path_length {} with {} spheres: this device drops what loops do after {} turns",
                           job.path_length, scene.spheres.size(), ocl::loop_limit(device.info));
    for (const std::string& reason :
         {tree_reason(scene, job.variant), ray_kind_reason(integrator, job.variant),
          reconstruction_reason(integrator, job.variant), aov_reason(integrator, scene, job),
          work_group_reason(integrator, device.info, job), launch_refusal(device, job),
          integrator.refusal(device, scene, job), memory_reason(integrator, device, scene, job)})
        if (!reason.empty()) return reason;
    return "";
}

}  // namespace ptb
