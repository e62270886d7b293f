#include "core/oracle/path.h"

namespace ptb {

OracleResult trace_direct(const Scene& scene, const OracleJob& job) {
    return sample_paths(scene, job, [&](Path& path) {
        PathSample sample;
        if (!reach_matte(path, job.path_length, sample) || sample.segments == job.path_length) return sample;
        path.scatter();
        if (path.advance()) sample.radiance = sample.radiance + path.emitted();
        return sample;
    });
}

}  // namespace ptb
