#pragma once

#include <optional>
#include <string>

#include "bench/plan/config.h"
#include "bench/record/record.h"

namespace ptb {

/// Version of the line protocol between coordinator and worker; a mismatch ends the run with exit code 7.
inline constexpr int protocol_version = 2;

/// Coordinator to worker, one JSON object a line. The first line is always `open`.
struct Request {
    enum class Kind { open, estimate, run, round, peaks };
    Kind kind = Kind::open;
    int protocol = protocol_version;
    MeasureOptions measure;             ///< open
    Case params;                        ///< estimate, run, round
    std::optional<double> time_left_s;  ///< run: what is left of the budget for this case
    std::string image_file;             ///< run: write the case's picture here, or empty
    int samples = 0;                    ///< round: how many
    bool operator==(const Request&) const = default;
};

/// Worker to coordinator. `open` is answered by `ready` or `failed`; `estimate` by `estimate` or `failed`;
/// `run` by any number of `progress` and one `record`; `round`, some samples of a case without its warm-up,
/// too; `peaks` like `run`, but by `peaks` or `failed`. A worker that is alive sends progress at least once a
/// pass.
struct Response {
    enum class Kind { ready, estimate, progress, record, failed, peaks };
    Kind kind = Kind::ready;
    int protocol = protocol_version;
    std::string tool_version;      ///< ready
    double ns_per_sample = 0;      ///< estimate: device time per pixel sample
    std::string stage;             ///< progress: "build", "validate", "warmup", "sample"
    double done = 0;               ///< progress: share of the stage, 0 to 1
    std::optional<Record> record;  ///< record
    std::string reason;            ///< failed
    std::vector<Peak> peaks;       ///< peaks
    bool device_failed =
        false;  ///< an OpenCL call failed: what this worker does from now on is worth nothing
    bool operator==(const Response&) const = default;
};

std::string to_line(const Request& request);
std::string to_line(const Response& response);
/// Throw std::runtime_error on anything that is not a message of this protocol.
Request parse_request(const std::string& line);
Response parse_response(const std::string& line);

}  // namespace ptb
