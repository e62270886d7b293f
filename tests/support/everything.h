#pragma once

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

/// Runs `body(device, integrator, lanes)` for each device and each integrator of spheres. On the first device
/// `pt`, whose machinery others share, has each of its lane widths, and others what they have unless told
/// otherwise; on the next ones they have one lane, and `pt` what it has unless told otherwise.
template <class Body>
void on_everything(Body&& body) {
    bool first = true;
    on_every_device([&](const ocl::Device& device) {
        for (const Integrator& row : integrators()) {
            if (!row.spheres) continue;
            const bool is_pt = row.id == "pt";
            const std::vector<int> one{is_pt || first ? default_lanes(row, device.info) : 1};
            const std::vector<int>& widths = first && is_pt ? row.lanes : one;
            for (const int lanes : widths) {
                SCOPED_TRACE(fmt::format("{}, lanes {}", row.id, lanes));
                body(device, row, lanes);
            }
        }
        first = false;
    });
}

}  // namespace ptb
