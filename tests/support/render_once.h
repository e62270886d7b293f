#pragma once

#include <cstdint>
#include <string>

#include "core/integrator/registry.h"

namespace ptb {

/// One pass that takes all there is.
inline constexpr std::uint64_t whole = ~std::uint64_t{0};

/// An integrator built for a scene, on a device, with options added to its own.
inline std::unique_ptr<Render> make_render(const ocl::Device& device, const std::string& kernel,
                                           const Scene& scene, const RenderJob& job,
                                           const std::string& more_options = "") {
    const Integrator& row = integrator(kernel);
    const ocl::Program program =
        ocl::build(device, kernel_source(row.file()), row.options(device, scene, job) + more_options);
    return row.make(device, program, scene, job);
}

/// Renders what is left, `samples` a pass.
inline Film finish(Render& render, std::uint64_t samples = whole) {
    while (render.samples_left() > 0) render.advance(samples);
    return render.read_film();
}

inline Film render_film(const ocl::Device& device, const std::string& kernel, const Scene& scene,
                        const RenderJob& job) {
    return finish(*make_render(device, kernel, scene, job));
}

}  // namespace ptb
