#pragma once

#include <optional>

#include "bench/workbench/pace.h"

namespace ptb {

/// A picture as far as it got.
struct Rendered {
    Image image;
    bool whole = false;  ///< not ended early
    double spp = 0;      ///< of the mean pixel
    double seconds = 0;  ///< of `time_s` the host's, else the device's
};

/// Renders a picture outside of any measurement; `time_s` is what its samples per pixel follow from, whatever
/// the job says. `progress` is told the share that is done, and answers whether to go on. Throws what goes
/// wrong.
Rendered render_picture(Builds& builds, Pace& pace, CaseJob job, std::optional<double> time_s,
                        const Progress& progress);

}  // namespace ptb
