#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/plan/case.h"
#include "bench/record/record.h"
#include "core/input/json.h"

namespace ptb {

/// What must be equal for two times to be comparable: "driver" -> "3.1".
using Fingerprint = std::vector<std::pair<std::string, std::string>>;

/// One case of one session, whichever tool measured it.
struct SessionCase {
    std::string device, name;    ///< together they are the case's identity
    std::optional<Case> params;  ///< of ptbench's own
    Fingerprint fingerprint;
    std::string no_time;                 ///< why there is no time, or empty
    std::vector<double> times_ns;        ///< of its samples; at least one, all above 0, unless `no_time`
    bool low_n = false;                  ///< too few samples to gate
    std::optional<double> efficiency{};  ///< 1 / (relMSE x s), of all pixels
    double median_ns() const;
};

/// One process run.
struct Session {
    std::string file, started_at;
    std::vector<SessionCase> cases;
};

/// Reads a result of ptbench, Google Benchmark (--benchmark_out_format=json) or nvbench (--json). Throws
/// UsageError, one line, on anything else.
Session read_session(const std::filesystem::path& file);
Session parse_session(std::string_view text, const std::string& file);

Session session_of(const ResultFile& result, const std::string& file);
/// Throw UsageError; `json` is an object.
Session google_benchmark_session(const Json& json, const std::string& file);
Session nvbench_session(const Json& json, const std::string& file);

}  // namespace ptb
