#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bench/plan/case.h"

namespace ptb {

/// One picture to make, outside of any measurement.
struct RenderRequest {
    Case params;  ///< `device` is a key of `probe_devices` in this process
    std::uint64_t seed = 1;
    std::string kernel_dir, output;  ///< output: .exr, .pfm, .png or .ppm
    std::optional<double> time_s{};  ///< what the samples per pixel follow from, whatever `params` says
};

/// What came of it.
struct Rendered {
    bool whole = false;  ///< not ended early
    double spp = 0;      ///< of the mean pixel
    double seconds = 0;
};

/// Renders in this process and writes the file; `stop` ends it early and keeps what is rendered.
Rendered render_to_file(const RenderRequest& request, std::function<void(double done)> progress,
                        const std::atomic<bool>& stop);

}  // namespace ptb
