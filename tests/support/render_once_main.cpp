// render_once KERNEL LANES SCENE: renders 8x8 pixels, 2 samples each, on the first device; SCENE is a shipped
// scene or "balls:N". For tools that watch a whole process, such as Oclgrind. Prints the counts.
#include <exception>
#include <string>

#include <fmt/format.h>

#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace {

ptb::Scene scene_of(const std::string& name) {
    const std::string balls = "balls:";
    if (name.rfind(balls, 0) == 0) return ptb::mixed_balls(std::stoi(name.substr(balls.size())));
    return ptb::shipped_scene(name);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    try {
        const ptb::ocl::Device device = ptb::ocl::open_device(ptb::ocl::query_devices().at(0).key);
        ptb::RenderJob job;
        job.size = {8, 8};
        job.spp = 2;
        job.path_length = 8;
        job.lanes = std::stoi(argv[2]);
        const ptb::Film film = ptb::render_film(device, argv[1], scene_of(argv[3]), job);
        fmt::print("{} on {}: {} segments\n", argv[1], device.info.name, film.segments);
        return film.segments >= 128 ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
}
