#pragma once

#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/integrator/registry.h"
#include "tests/support/devices.h"

namespace ptb {

/// Of odd sizes. Builds for its path length are those of most tests: drivers keep them.
inline RenderJob small_job(int lanes) {
    RenderJob job;
    job.size = {37, 21};
    job.spp = 7;
    job.path_length = 6;
    job.lanes = lanes;
    return job;
}

/// Runs `body(device, integrator, lanes)` for each device and each integrator of spheres: `pt`, whose
/// machinery others share, with each of its lane widths, others with one lane and with what they have unless
/// told otherwise.
template <class Body>
void on_everything(Body&& body) {
    on_every_device([&](const ocl::Device& device) {
        for (const Integrator& row : integrators()) {
            if (!row.spheres) continue;
            std::set<int> widths{1, default_lanes(row, device.info)};
            if (row.id == "pt") widths.insert(row.lanes.begin(), row.lanes.end());
            for (const int lanes : widths) {
                SCOPED_TRACE(fmt::format("{}, lanes {}", row.id, lanes));
                body(device, row, lanes);
            }
        }
    });
}

}  // namespace ptb
