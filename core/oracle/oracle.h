#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "core/image/image.h"
#include "core/scene/scene.h"

namespace ptb {

/// What the host tracers leave: per pixel the mean radiance and the unbiased variance of one sample.
struct OracleResult {
    Image mean;
    Image variance;
    std::uint64_t samples = 0;
    std::uint64_t segments = 0;           ///< path segments, the camera's and an escaping one included
    double segments_variance = 0;         ///< unbiased variance of one sample's segment count
    std::uint64_t full_length_paths = 0;  ///< paths that traced path_length segments
};

struct OracleJob {
    Size size;
    int spp = 1;
    int path_length = 128;
    std::uint64_t seed = 1;
    int threads = 1;
    bool pixel_centres = false;                 ///< every sample goes through the middle of its pixel
    std::function<void(int rows_done)> on_row;  ///< progress, or empty; from any thread, one call at a time
};

/// The physically right estimator (the kernel `pt`'s truth): box-filtered pixels, exact dielectric Fresnel,
/// cosine-weighted Lambert, no next-event estimation, no roulette.
OracleResult trace_pt(const Scene& scene, const OracleJob& job);

/// As `trace_pt` to the first matte surface, which is lit by what its next segment meets: lamps as they are,
/// nothing by way of mirrors, glass or other matte surfaces.
OracleResult trace_direct(const Scene& scene, const OracleJob& job);

/// As `trace_direct`, but the first matte surface is lit by each lamp's power from one point of it.
OracleResult trace_whitted(const Scene& scene, const OracleJob& job);

/// The thesis' algorithm with its defects (the kernel `thesis`' twin), in double precision. Of spheres alone:
/// throws std::invalid_argument where there are meshes.
OracleResult trace_thesis(const Scene& scene, const OracleJob& job);

using Tracer = OracleResult (*)(const Scene&, const OracleJob&);

/// The tracers above by the kernels whose truth they are.
const std::map<std::string, Tracer>& tracers();

}  // namespace ptb
