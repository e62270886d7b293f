#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/plan/case.h"
#include "bench/record/record.h"
#include "core/input/json.h"

namespace ptb {

/// What must be equal for two times to be comparable: {"driver", "3.1"}. A fact that one side does not have
/// is no difference.
struct Fact {
    std::string field, value;
    bool may_differ = false;  ///< which is then noted, and no more: a container's host name
    bool operator==(const Fact&) const = default;
};
using Fingerprint = std::vector<Fact>;

/// One case of one session, whichever tool measured it.
struct SessionCase {
    std::string device, name;              ///< as the session calls them
    std::string device_name, device_uuid;  ///< of the hardware, where they are known
    std::optional<Case> params;            ///< of ptbench's own; `name` is its text
    std::string scene_hash;                ///< of its scene's text, where that is known
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
    std::string revision{};  ///< of the source of what was measured, where it is known
};

/// Reads a result or journal of ptbench, or a result of Google Benchmark (--benchmark_out_format=json) or
/// nvbench
/// (--json); "-" is stdin. Throws UsageError, one line, on anything else.
Session read_session(const std::filesystem::path& file);
Session parse_session(std::string_view text, const std::string& file);

Session session_of(const ResultFile& result, const std::string& file);
/// Throw UsageError; `json` is an object.
Session google_benchmark_session(const Json& json, const std::string& file);
Session nvbench_session(const Json& json, const std::string& file);

}  // namespace ptb
