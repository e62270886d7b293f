#include "core/integrator/engine_options.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/integrator/device_lamps.h"
#include "core/integrator/device_meshes.h"
#include "core/integrator/film.h"
#include "core/integrator/placement.h"
#include "core/integrator/variant_support.h"
#include "core/ocl/program.h"
#include "core/scene/lamps.h"

namespace ptb {

namespace {

/// An emitter that also scatters.
bool glows(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.scatters && dot(m.radiance, m.radiance) > 0; });
}

/// Where spheres and surfaces lie: SCENE_IN_...
struct Places {
    int spheres, surfaces;
};

Places places_of(const ocl::Device& device, const DeviceScene& scene, const RenderJob& job) {
    switch (job.variant.scene_memory) {
        case SceneMemory::constant:
            return {SCENE_IN_CONSTANT, SCENE_IN_CONSTANT};
        case SceneMemory::global:
            return {SCENE_IN_GLOBAL, SCENE_IN_GLOBAL};
        case SceneMemory::local:
            return {SCENE_IN_LOCAL, SCENE_IN_LOCAL};
        case SceneMemory::private_memory:
            return {SCENE_IN_PRIVATE, SCENE_IN_PRIVATE};
        case SceneMemory::automatic:
        case SceneMemory::argument:
            break;
    }
    if (scene.is_few())
        return {SCENE_IN_ARGUMENT,
                is_throughput_device(device) && job.lanes == 1 ? SCENE_IN_LOCAL : SCENE_IN_CONSTANT};
    return scene.read_bytes() <= device.info.constant_bytes ? Places{SCENE_IN_CONSTANT, SCENE_IN_CONSTANT}
                                                            : Places{SCENE_IN_GLOBAL, SCENE_IN_GLOBAL};
}

std::string memory_refusal(const Integrator& row, const ocl::Device& device, const DeviceScene& scene,
                           const RenderJob& job) {
    const std::uint64_t bytes = scene.read_bytes();
    const auto refused = [&](const std::string& memory, std::uint64_t limit) {
        return fmt::format("scene_memory {}: {} spheres take {} bytes, this device has {}", memory,
                           scene.spheres.size(), bytes, limit);
    };
    const SceneMemory memory = job.variant.scene_memory;
    if (memory == SceneMemory::constant && bytes > device.info.constant_bytes)
        return refused("constant", device.info.constant_bytes);
    if (memory == SceneMemory::local && bytes > device.info.local_bytes)
        return refused("local", device.info.local_bytes);
    if (scene.has_meshes && memory != SceneMemory::automatic && memory != SceneMemory::constant &&
        memory != SceneMemory::global)
        return fmt::format("scene_memory {}: {} has spheres beside meshes in auto, constant, global",
                           variant_value("scene_memory", job.variant), row.id);
    const bool by_value = memory == SceneMemory::argument || memory == SceneMemory::private_memory;
    if (by_value && !scene.is_few())
        return fmt::format("scene_memory {}: {} takes at most {} faces so, these {} spheres have {}",
                           memory == SceneMemory::argument ? "argument" : "private", row.id, SCENE_FEW_MOST,
                           scene.spheres.size(), scene.faces());
    return "";
}

/// CPUs have registers of eight floats. On GPUs bvh2q where lanes wait for each other, since loads count
/// then; bvh2 where each ray is searched for to its end, since instructions do.
TreeLayout layout_of(const Integrator& row, const ocl::Device& device, const Variant& variant) {
    switch (variant.bvh) {
        case Bvh::bvh2:
            return TreeLayout::bvh2;
        case Bvh::bvh2q:
            return TreeLayout::bvh2q;
        case Bvh::wide8:
            return TreeLayout::wide8;
        case Bvh::automatic:
            break;
    }
    if (!is_throughput_device(device)) return TreeLayout::wide8;
    return row.rays_wait ? TreeLayout::bvh2q : TreeLayout::bvh2;
}

/// Nodes of two loads in place of four are worth that much larger leaves: in a flake whose room is 64 times
/// as large they are 0.75 with leaves 5.5 times as large, 256 times 2.3 with 40.
constexpr double bearable_grid_growth = 4;

TreeSettings settings_of(const Variant& variant, TreeLayout layout) {
    const BvhSplit split = variant.bvh_split;
    TreeSettings settings;
    const bool spatial = split == BvhSplit::spatial || split == BvhSplit::spatial_xyz;
    settings.method = spatial ? TreeMethod::spatial : TreeMethod::sah;
    settings.size_axis = split == BvhSplit::spatial || split == BvhSplit::sah;
    if (variant.bvh == Bvh::automatic && layout == TreeLayout::bvh2q)
        settings.grid_growth_most = bearable_grid_growth;
    return settings;
}

/// Stacks of so many links or the next multiple share a build.
constexpr int stack_step = 16;

/// NVIDIA's runtime takes groups of 256 where none are asked for, and more than 80 registers a lane leave
/// room for two of them in place of three (H200, knot: pt_nee 45.2 -> 36.9 ms, pt_lt 48.6 -> 41.3).
std::string register_option(const Integrator& row, const ocl::Device& device) {
    return row.rays_wait && ocl::takes_nvidia_options(device) ? " -cl-nv-maxrregcount=80" : "";
}

std::string mesh_options(const Integrator& row, const ocl::Device& device, const DeviceScene& scene) {
    std::string text = tree_options(device, *scene.meshes.tree);
    if (is_throughput_device(device)) text += " -DSCENE_PAUSES" + register_option(row, device);
    if (scene.meshes.refract) text += " -DSCENE_GLASS";
    return text;
}

/// Whether a path may carry every sphere's gap: each move adds an error of its own, as in a random walk.
bool carries_gaps(const DeviceScene& scene, int path_length) {
    return scene.is_few() && !scene.has_careful() &&
           scene.plain_error * std::sqrt(path_length) <= bearable_error;
}

/// The kernel divides by products, which are exact up to here.
constexpr std::uint32_t most_rows = (1u << 22) - 1;

std::string placement_refusal(const Integrator& row, const Scene& scene) {
    const Placement placement = place(scene);
    if (!placement.lost) return "";
    const Sphere& sphere = scene.spheres[*placement.lost];
    return fmt::format(
        "scene {}: /spheres/{}: {}'s single precision loses a radius of {:g} at a distance of {:g}",
        scene.name, *placement.lost, row.id, sphere.radius, length(sphere.centre - placement.origin));
}

/// What other samples add to a pixel lies anywhere in it.
std::string filter_refusal(const Integrator& row, const RenderJob& job) {
    if (row.independent_pixels) return "";
    return choice_refusal(row.id, "pixel_filter", job.variant, {"jitter", "stratified"});
}

/// The vertices of paths that are joined lie in private memory, some 60 bytes each a lane.
constexpr int longest_joined = 256;

std::string length_refusal(const Integrator& row, const RenderJob& job) {
    if (!row.joins_paths || job.path_length <= longest_joined) return "";
    return fmt::format("path_length {}: {} takes at most {}", job.path_length, row.id, longest_joined);
}

/// Light all around is met, but cannot be asked for.
std::string surrounding_refusal(const Integrator& row, const Scene& scene) {
    if (!row.only_asks) return "";
    for (const Lamp& lamp : find_lamps(scene).lamps)
        if (lamp.around_camera)
            return fmt::format(
                "scene {}: /spheres/{} shines around the camera, where {} cannot ask it for light",
                scene.name, lamp.sphere, row.id);
    return "";
}

std::string rows_refusal(const Integrator& row, const RenderJob& job) {
    if (static_cast<std::uint32_t>(job.size.height) > most_rows)
        return fmt::format("size {}x{}: {} takes at most {} rows", job.size.width, job.size.height, row.id,
                           most_rows);
    const auto spp = static_cast<std::uint32_t>(job.spp);
    if (job.variant.pixel_filter != PixelFilter::stratified || spp / strata_columns(spp) <= most_rows)
        return "";
    return fmt::format("pixel_filter stratified: {} samples make a grid of {} rows, {} takes at most {}", spp,
                       spp / strata_columns(spp), row.id, most_rows);
}

}  // namespace

std::uint32_t strata_columns(std::uint32_t spp) {
    auto columns = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(spp)));
    while (spp % columns != 0) --columns;
    return columns;
}

std::string tree_options(const ocl::Device& device, const Tree& tree) {
    return fmt::format(" -DSCENE_TREE={} -DTREE_STACK={}{}{}", tree.nodes8.empty() ? 2 : 8,
                       (tree.facts.stack_most / stack_step + 1) * stack_step,
                       tree.nodes2q.empty() ? "" : " -DTREE_QUANTISED",
                       is_throughput_device(device) ? "" : " -DENGINE_ALONE");
}

std::string mesh_refusal(const Integrator& row, const ocl::Device& device, const Scene& scene,
                         const RenderJob& job) {
    if (scene.meshes.empty()) return "";
    if (job.lanes != 1)
        return fmt::format("lanes {}: {} has 1 with meshes, as in scene {}", job.lanes, row.id, scene.name);
    if (ocl::bounds_loops(device.info))
        return fmt::format("scene {} has meshes: this device drops what loops do after {} turns", scene.name,
                           ocl::loop_limit(device.info));
    if (job.variant.build == BuildMode::relaxed)
        return fmt::format("build relaxed: {} loses rays at edges so; with meshes it has default, strict",
                           row.id);
    return "";
}

DeviceScene device_scene_for(const Integrator& row, const ocl::Device& device, const Scene& scene,
                             const RenderJob& job) {
    DeviceScene result = make_device_scene(scene);
    const TreeLayout layout = layout_of(row, device, job.variant);
    add_meshes(result, scene, layout, settings_of(job.variant, layout));
    if (row.samples_lamps) add_lamps(result, scene);
    return result;
}

std::shared_ptr<const Tree> tree_for(const Integrator& row, const ocl::Device& device, const Scene& scene,
                                     const RenderJob& job) {
    if (scene.meshes.empty()) return nullptr;
    const TreeLayout layout = layout_of(row, device, job.variant);
    return mesh_tree(scene, make_device_scene(scene).origin, layout, settings_of(job.variant, layout));
}

std::string engine_refusal(const Integrator& row, const ocl::Device& device, const Scene& scene,
                           const RenderJob& job) {
    for (const std::string& reason :
         {mesh_refusal(row, device, scene, job), placement_refusal(row, scene),
          surrounding_refusal(row, scene), filter_refusal(row, job), length_refusal(row, job),
          memory_refusal(row, device, make_device_scene(scene), job),
          film_refusal(device, job.size, job.variant.film_memory), rows_refusal(row, job)})
        if (!reason.empty()) return reason;
    return "";
}

std::string engine_options(const Integrator& row, const ocl::Device& device, const Scene& scene,
                           const RenderJob& job) {
    const DeviceScene device_scene = device_scene_for(row, device, scene, job);
    const Places places = places_of(device, device_scene, job);
    const bool lone_on_gpu = is_throughput_device(device) && job.lanes == 1;
    std::string text = common_options(device, job);
    text += fmt::format(" -DPTB_LANES={} -DSCENE_SIDE_WORDS={}", job.lanes, device_scene.camera_sides.size());
    if (job.lanes > 1) text += fmt::format(" -DPTB_WIDTH={}", device.info.native_float_width);
    text += fmt::format(" -DSCENE_SPHERES={} -DSCENE_SURFACES={}", places.spheres, places.surfaces);
    if (device_scene.is_few())
        text += fmt::format(
            " -DSCENE_FEW={} -DSCENE_OPAQUE={} -DSCENE_ZERO_X={:#x} -DSCENE_ZERO_Y={:#x} "
            "-DSCENE_ZERO_Z={:#x}",
            device_scene.spheres.size(), device_scene.opaque, device_scene.zeros[0], device_scene.zeros[1],
            device_scene.zeros[2]);
    else if (device_scene.spheres.empty())
        text += " -DSCENE_NO_SPHERES";
    else if (places.spheres == SCENE_IN_LOCAL)
        text += fmt::format(" -DSCENE_COUNT={} -DSCENE_FACES={}", device_scene.spheres.size(),
                            device_scene.faces());
    if (ocl::bounds_loops(device.info)) text += " -DENGINE_BOUNDED";
    if (glows(scene)) text += " -DSCENE_GLOWS";
    if (lone_on_gpu && !device_scene.has_meshes) text += " -DENGINE_BATCH=6";
    if (lone_on_gpu && row.independent_pixels && carries_gaps(device_scene, job.path_length))
        text += " -DSCENE_CARRIED";
    if (device_scene.has_careful())
        text += fmt::format(
            " -DSCENE_CAREFUL_BEGIN={}u -DSCENE_CAREFUL_END={}u -DSCENE_DISTANT_BEGIN={}u "
            "-DSCENE_DISTANT_END={}u",
            device_scene.careful.begin, device_scene.careful.end, device_scene.distant.begin,
            device_scene.distant.end);
    if (job.variant.pixel_filter != PixelFilter::jitter)
        text +=
            fmt::format(" -DENGINE_FILTER={}",
                        job.variant.pixel_filter == PixelFilter::centre ? ENGINE_CENTRE : ENGINE_STRATIFIED);
    if (device_scene.has_meshes) text += mesh_options(row, device, device_scene);
    const bool many_lamps = device_scene.lamps.size() > 1 || device_scene.has_meshes;
    if (row.samples_lamps && many_lamps) text += " -DSCENE_MANY_LAMPS";
    if (row.samples_lamps && !many_lamps)
        text +=
            fmt::format(" -DSCENE_LONE_LAMP={}",
                        std::isinf(device_scene.lone_lamp.near_squared) ? SCENE_FREE_LAMP : SCENE_SUNK_LAMP);
    if (row.joins_paths || row.gradients) text += fmt::format(" -DENGINE_PATH_LENGTH={}", job.path_length);
    if (job.variant.roulette == Roulette::albedo) text += " -DENGINE_ROULETTE";
    if (job.variant.film_memory == FilmMemory::image) text += " -DENGINE_IMAGE_FILM";
    if (job.variant.rng == Rng::park_miller) text += " -DPTB_PARK_MILLER";
    if (job.aov == Aov::cost) text += std::string(count_option) + " -DENGINE_COST";
    return text;
}

int most_rays(const Integrator& row, int path_length) {
    const int joined = std::min(path_length, longest_joined);
    const int rays = !row.joins_paths ? path_length : joined * (joined + 5) / 2;
    // Of each of four neighbours: the way along the path, what is asked and joined at its first matte vertex
    // and the one after that, and what is met and seen of each vertex that is shown.
    return !row.gradients ? rays : rays + 4 * (4 * path_length + 2);
}

bool is_throughput_device(const ocl::Device& device) { return device.info.type != "CPU"; }

}  // namespace ptb
