#pragma once

#include <functional>
#include <string>

#include "bench/measure/sampler.h"

namespace ptb {

/// Told how far a case has come: stage "build", "validate", "idle", "warmup", "sample",
/// "beside" (others), "noise" or "count",
/// and the share of it done.
using Stage = std::function<void(const std::string& stage, double done)>;

/// Reports the passes of a render as a stage of this name. `stage` outlives it.
inline Progress passes(const Stage& stage, const std::string& name) {
    return [&stage, name](double done) {
        stage(name, done);
        return true;
    };
}

}  // namespace ptb
