#include "core/oracle/path.h"

namespace ptb {

OracleResult trace_pt(const Scene& scene, const OracleJob& job) {
    return sample_paths(scene, job, [&](Path& path) {
        PathSample sample;
        while (reach_matte(path, job.path_length, sample)) path.scatter();
        return sample;
    });
}

}  // namespace ptb
