#include "core/integrator/pt_options.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/integrator/placement.h"
#include "core/integrator/pt_film.h"
#include "core/integrator/pt_scene.h"
#include "core/integrator/variant_support.h"

namespace ptb {

namespace {

/// An emitter that also scatters.
bool glows(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.scatters && dot(m.radiance, m.radiance) > 0; });
}

/// Where spheres and surfaces lie: PT_IN_...
struct Places {
    int spheres, surfaces;
};

Places places_of(const ocl::Device& device, const PtScene& scene, const RenderJob& job) {
    switch (job.variant.scene_memory) {
        case SceneMemory::constant:
            return {PT_IN_CONSTANT, PT_IN_CONSTANT};
        case SceneMemory::global:
            return {PT_IN_GLOBAL, PT_IN_GLOBAL};
        case SceneMemory::local:
            return {PT_IN_LOCAL, PT_IN_LOCAL};
        case SceneMemory::private_memory:
            return {PT_IN_PRIVATE, PT_IN_PRIVATE};
        case SceneMemory::automatic:
        case SceneMemory::argument:
            break;
    }
    if (scene.is_few())
        return {PT_IN_ARGUMENT,
                is_throughput_device(device) && job.lanes == 1 ? PT_IN_LOCAL : PT_IN_CONSTANT};
    return scene.bytes() <= device.info.constant_bytes ? Places{PT_IN_CONSTANT, PT_IN_CONSTANT}
                                                       : Places{PT_IN_GLOBAL, PT_IN_GLOBAL};
}

std::string memory_refusal(const ocl::Device& device, const PtScene& scene, const RenderJob& job) {
    const std::uint64_t bytes = scene.bytes();
    const auto refused = [&](const std::string& memory, std::uint64_t limit) {
        return fmt::format("scene_memory {}: {} spheres take {} bytes, this device has {}", memory,
                           scene.spheres.size(), bytes, limit);
    };
    const SceneMemory memory = job.variant.scene_memory;
    if (memory == SceneMemory::constant && bytes > device.info.constant_bytes)
        return refused("constant", device.info.constant_bytes);
    if (memory == SceneMemory::local && bytes > device.info.local_bytes)
        return refused("local", device.info.local_bytes);
    const bool by_value = memory == SceneMemory::argument || memory == SceneMemory::private_memory;
    if (by_value && !scene.is_few())
        return fmt::format("scene_memory {}: pt takes at most {} faces so, these {} spheres have {}",
                           memory == SceneMemory::argument ? "argument" : "private", PT_FEW_MOST,
                           scene.spheres.size(), scene.faces());
    return "";
}

/// Whether a path may carry every sphere's gap: each move adds an error of its own, as in a random walk.
bool carries_gaps(const PtScene& scene, int path_length) {
    return scene.is_few() && !scene.has_careful() &&
           scene.plain_error * std::sqrt(path_length) <= bearable_error;
}

/// The kernel divides by products, which are exact up to here.
constexpr std::uint32_t most_rows = (1u << 22) - 1;

std::string placement_refusal(const Scene& scene) {
    const Placement placement = place(scene);
    if (!placement.lost) return "";
    const Sphere& sphere = scene.spheres[*placement.lost];
    return fmt::format(
        "scene {}: /spheres/{}: pt's single precision loses a radius of {:g} at a distance of {:g}",
        scene.name, *placement.lost, sphere.radius, length(sphere.centre - placement.origin));
}

std::string rows_refusal(const RenderJob& job) {
    if (static_cast<std::uint32_t>(job.size.height) > most_rows)
        return fmt::format("size {}x{}: pt takes at most {} rows", job.size.width, job.size.height,
                           most_rows);
    const auto spp = static_cast<std::uint32_t>(job.spp);
    if (job.variant.pixel_filter != PixelFilter::stratified || spp / strata_columns(spp) <= most_rows)
        return "";
    return fmt::format("pixel_filter stratified: {} samples make a grid of {} rows, pt takes at most {}", spp,
                       spp / strata_columns(spp), most_rows);
}

}  // namespace

std::uint32_t strata_columns(std::uint32_t spp) {
    auto columns = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(spp)));
    while (spp % columns != 0) --columns;
    return columns;
}

std::string pt_refusal(const ocl::Device& device, const Scene& scene, const RenderJob& job) {
    for (const std::string& reason :
         {placement_refusal(scene), memory_refusal(device, make_pt_scene(scene), job),
          pt_film_refusal(device, job.size, job.variant.film_memory), rows_refusal(job)})
        if (!reason.empty()) return reason;
    return "";
}

std::string pt_options(const ocl::Device& device, const Scene& scene, const RenderJob& job) {
    const PtScene pt_scene = make_pt_scene(scene);
    const Places places = places_of(device, pt_scene, job);
    const bool lone_on_gpu = is_throughput_device(device) && job.lanes == 1;
    std::string text = common_options(device, job);
    text += fmt::format(" -DPTB_LANES={} -DPT_SIDE_WORDS={}", job.lanes, pt_scene.camera_sides.size());
    if (job.lanes > 1) text += fmt::format(" -DPTB_WIDTH={}", device.info.native_float_width);
    text += fmt::format(" -DPT_SPHERES={} -DPT_SURFACES={}", places.spheres, places.surfaces);
    if (pt_scene.is_few())
        text +=
            fmt::format(" -DPT_FEW={} -DPT_OPAQUE={} -DPT_ZERO_X={:#x} -DPT_ZERO_Y={:#x} -DPT_ZERO_Z={:#x}",
                        pt_scene.spheres.size(), pt_scene.opaque, pt_scene.zeros[0], pt_scene.zeros[1],
                        pt_scene.zeros[2]);
    else if (places.spheres == PT_IN_LOCAL)
        text += fmt::format(" -DPT_COUNT={} -DPT_FACES={}", pt_scene.spheres.size(), pt_scene.faces());
    if (ocl::bounds_loops(device.info)) text += " -DPT_BOUNDED";
    if (glows(scene)) text += " -DPT_GLOWS";
    if (lone_on_gpu) text += " -DPT_BATCH=6";
    if (lone_on_gpu && carries_gaps(pt_scene, job.path_length)) text += " -DPT_CARRIED";
    if (pt_scene.has_careful())
        text += fmt::format(
            " -DPT_CAREFUL_BEGIN={}u -DPT_CAREFUL_END={}u -DPT_DISTANT_BEGIN={}u -DPT_DISTANT_END={}u",
            pt_scene.careful.begin, pt_scene.careful.end, pt_scene.distant.begin, pt_scene.distant.end);
    if (job.variant.pixel_filter != PixelFilter::jitter)
        text += fmt::format(" -DPT_FILTER={}",
                            job.variant.pixel_filter == PixelFilter::centre ? PT_CENTRE : PT_STRATIFIED);
    if (job.variant.rng == Rng::park_miller) text += " -DPTB_PARK_MILLER";
    return text;
}

bool is_throughput_device(const ocl::Device& device) { return device.info.type != "CPU"; }

}  // namespace ptb
