#pragma once

#include <cstdint>
#include <string>

#include "bench/record/fields.h"
#include "bench/record/fingerprint.h"
#include "core/input/usage_error.h"

namespace ptb {

/// One worker process, wherever it runs. Two equal identities are the same process.
struct WorkerIdentity {
    std::string nonce;  ///< of its command line
    std::string host;
    std::int64_t pid = 0;
    std::string drawn;  ///< by itself at random: containers may share host and pid
    bool operator==(const WorkerIdentity&) const = default;
};

template <>
inline constexpr auto fields<WorkerIdentity> = std::make_tuple(required("nonce", &WorkerIdentity::nonce),
                                                               required("host", &WorkerIdentity::host),
                                                               required("pid", &WorkerIdentity::pid),
                                                               required("drawn", &WorkerIdentity::drawn));

/// What a worker's times are of: "ptbench": "0.1.0 4fd1c2", "kernel pt": "9f86d081884c7d65".
struct WorkerFacts {
    RunFingerprint facts;
    bool operator==(const WorkerFacts&) const = default;
};

/// 16 hexadecimal digits drawn at random.
std::string drawn_nonce();

/// This process, with the nonce of its command line.
WorkerIdentity this_worker(const std::string& nonce);

/// Of this binary, with kernels from `kernel_dir` where that is not empty.
WorkerFacts facts_here(const std::string& kernel_dir);

/// "process 17 on node7"
std::string text_of(const WorkerIdentity& worker);

/// A launcher that started more than one worker: they would disturb each other.
struct TwoWorkers : UsageError {
    using UsageError::UsageError;
};

/// Throws TwoWorkers when `other` is not `worker`.
void check_one(const WorkerIdentity& worker, const WorkerIdentity& other);

}  // namespace ptb
