// Renders 8x8 pixels of a scene file on the first device.
#include <cstdio>

#include <core/integrator/registry.h>
#include <core/ocl/device.h>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const ptb::Scene scene = ptb::load_scene(argv[1]);
    const ptb::ocl::Device device = ptb::ocl::open_device(ptb::ocl::query_devices().at(0).key);
    const ptb::Integrator& pt = ptb::integrator("pt");
    ptb::RenderJob job;
    job.size = {8, 8};
    job.spp = 2;
    const ptb::ocl::Program program =
        ptb::ocl::build(device, ptb::kernel_source(pt.file()), pt.options(device, scene, job));
    const auto render = pt.make(device, program, scene, job);
    while (render->samples_left() > 0) render->advance(render->samples_left());
    std::printf("%s 8x8: %llu samples\n", scene.name.c_str(),
                static_cast<unsigned long long>(render->read_film().samples.value_or(0)));
}
