// render_once KERNEL LANES SCENE [SPP PATH_LENGTH [OPTIONS]]: renders 7x5 pixels, 2 samples each and paths of
// 8 segments unless told otherwise, on the first device; SCENE is a shipped scene, "far_apart", "at_a_wall",
// "mesh_room" or "balls:N", OPTIONS are more of the build; words like "rng=park_miller", anywhere, choose a
// variant, "work_group=64" the work-groups. For tools that watch a whole process, such as Oclgrind. Prints
// the counts.
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

/// In place of the loader's: Oclgrind 21.10 takes what was filled for uninitialised, unlike what was written.
cl_int clEnqueueFillBuffer(cl_command_queue queue, cl_mem buffer, const void* pattern,
                           std::size_t pattern_bytes, std::size_t offset, std::size_t bytes, cl_uint events,
                           const cl_event* wait_for, cl_event* event) {
    std::vector<char> filled(bytes);
    for (std::size_t at = 0; at < bytes; at += pattern_bytes)
        std::memcpy(&filled[at], pattern, pattern_bytes);
    return clEnqueueWriteBuffer(queue, buffer, CL_TRUE, offset, bytes, filled.data(), events, wait_for,
                                event);
}

namespace {

ptb::Scene scene_of(const std::string& name) {
    const std::string balls = "balls:";
    if (name.rfind(balls, 0) == 0) return ptb::mixed_balls(std::stoi(name.substr(balls.size())));
    if (name == "mesh_room") return ptb::mesh_room();
    if (name == "far_apart") return ptb::balls_far_apart(10'000);
    if (name == "at_a_wall") return ptb::balls_at_a_wall(1e8, "matte");
    return ptb::shipped_scene(name);
}

/// Takes the words like "rng=park_miller" from the arguments.
ptb::Variant take_variant(std::vector<char*>& arguments) {
    ptb::Variant variant;
    std::erase_if(arguments, [&](const std::string& word) {
        for (const ptb::VariantAxis& axis : ptb::variant_axes())
            for (std::size_t value = 0; value < axis.values.size(); ++value)
                if (word == axis.name + "=" + axis.values[value]) return axis.set(variant, value), true;
        return false;
    });
    return variant;
}

/// Takes a word like "work_group=64" from the arguments; 0 without one.
int take_work_group(std::vector<char*>& arguments) {
    const std::string key = "work_group=";
    int work_group = 0;
    std::erase_if(arguments, [&](const std::string& word) {
        if (word.rfind(key, 0) != 0) return false;
        work_group = std::stoi(word.substr(key.size()));
        return true;
    });
    return work_group;
}

}  // namespace

int main(int all_arguments, char** words) {
    std::vector<char*> argv(words, words + all_arguments);
    const ptb::Variant variant = take_variant(argv);
    const int work_group = take_work_group(argv);
    const std::size_t argc = argv.size();
    if (argc != 4 && argc != 6 && argc != 7) return 2;
    try {
        const ptb::ocl::Device device = ptb::ocl::open_device(ptb::ocl::query_devices().at(0).key);
        ptb::RenderJob job;
        job.size = {7, 5};
        job.spp = argc > 4 ? std::stoi(argv[4]) : 2;
        job.path_length = argc > 4 ? std::stoi(argv[5]) : 8;
        job.lanes = std::stoi(argv[2]);
        job.variant = variant;
        job.work_group_x = work_group;
        const auto render =
            ptb::make_render(device, argv[1], scene_of(argv[3]), job, argc > 6 ? argv[6] : "");
        const ptb::Film film = ptb::finish(*render);
        fmt::print("{} on {}: {} segments\n", argv[1], device.info.name, film.segments);
        if (const auto counts = render->counts())
            fmt::print(
                "counted: {} segments, {} lanes, {} flops, {} roots, {} divisions, {} bytes, "
                "{} searches, {} nodes, {} triangles\n",
                counts->segments, counts->lanes, counts->flops, counts->roots, counts->divisions,
                counts->bytes, counts->searches, counts->nodes, counts->triangles);
        return film.segments >= film.samples ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
}
