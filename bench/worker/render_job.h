#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bench/plan/case.h"
#include "core/image/image.h"

namespace ptb {

/// One picture to make, outside of any measurement.
struct RenderRequest {
    Case params;  ///< `device` is a key of `probe_devices` in this process
    std::uint64_t seed = 1;
    std::string kernel_dir;
};

/// A picture as far as it got.
struct Rendered {
    Image image;
    bool whole = false;
};

/// Renders in this process; `progress` is told the share that is done, and answers whether to go on. Throws
/// UsageError for what this device cannot do.
Rendered render_picture(const RenderRequest& request, const std::function<bool(double done)>& progress);

}  // namespace ptb
