#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/plan/config.h"
#include "bench/record/record.h"
#include "bench/worker/identity.h"
#include "core/render/film_sums.h"
#include "core/render/parts.h"
#include "core/render/render.h"

namespace ptb {

/// Version of the line protocol between coordinator and worker; a mismatch ends the run with exit code 7.
inline constexpr int protocol_version = 5;

/// Coordinator to worker, one JSON object a line. The first line is always `open`; `stop` is no request of
/// its own, but ends the `render` or `render_parts` of its number early, and what a `run` does beside others.
/// A worker whose stdin ends is not wanted any more.
struct Request {
    enum class Kind {
        open,
        estimate,
        run,
        round,
        peaks,
        render,
        stop,
        share_picture,
        render_parts,
        give_film
    };
    Kind kind = Kind::open;
    int protocol = protocol_version;
    std::int64_t number = 0;            ///< counted from 1; the channel sets it
    MeasureOptions measure;             ///< open
    Case params;                        ///< estimate, run, round, render, share_picture
    std::optional<double> time_left_s;  ///< run: what is left of the budget for this case
    std::string scene_hash;             ///< of the scene's content where the request comes from, or empty
    bool picture = false;               ///< run: send the timed picture, too
    bool validate_only = false;         ///< run: what is timed later
    bool beside_others = false;         ///< run: stay busy when measured, until `stop`
    std::optional<double> time_s;       ///< render: how long, whatever the case says of samples
    int samples = 0;                    ///< round: how many
    Aov aov = Aov::radiance;            ///< render: what pixels have
    std::optional<RunCut> cut;          ///< share_picture: as an earlier device cut it into runs
    PartRange parts;                    ///< render_parts
    std::string film_file;              ///< share_picture: for the film, memory of both
    bool operator==(const Request&) const = default;
};

/// Worker to coordinator. `open` is answered by `ready` or `failed`; `estimate` by `estimate` or `failed`;
/// `run` by any number of `progress` and `pixels` and one `record`; `round`, some samples of a case without
/// its warm-up, too; `peaks` like `run`, but by `peaks` or `failed`; `render` by `rendered`, `failed` or, for
/// what this device cannot do, `refused`. `share_picture` begins this device's parts of a picture that
/// several make, and is answered by `sharing` or like `render`; `render_parts` by `parts_done`, `give_film`,
/// which empties the film, by `film_given`, or both by `failed`. A worker that is alive sends progress at
/// least once a pass, the first one before it touches a device.
struct Response {
    enum class Kind {
        ready,
        estimate,
        progress,
        record,
        failed,
        peaks,
        pixels,
        rendered,
        refused,
        sharing,
        parts_done,
        film_given
    };
    Kind kind = Kind::ready;
    int protocol = protocol_version;
    std::int64_t number = 0;  ///< of the request that it answers
    WorkerIdentity worker;
    WorkerFacts facts;              ///< ready
    double ns_per_sample = 0;       ///< estimate: device time per pixel sample
    std::string stage;              ///< progress: "open", "build", "validate", "warmup", "sample", "render"
    double done = 0;                ///< progress: share of the stage, 0 to 1
    std::optional<Record> record;   ///< record
    int first_row = 0;              ///< pixels
    std::string rgb;                ///< pixels: whole rows of floats in base64
    bool whole = false;             ///< rendered: it was not stopped
    double spp = 0, seconds = 0;    ///< rendered: samples of the mean pixel, and how long they took
    std::optional<RunCut> cut;      ///< sharing
    std::uint64_t part_count = 0;   ///< sharing: of the whole picture
    PartRange parts;                ///< parts_done: of those asked for, from the first on
    double device_s = 0;            ///< parts_done: beside `seconds` by the host's clock
    std::optional<FilmFacts> film;  ///< film_given: of the pixels that lie in the film's file now
    std::string reason;             ///< failed, refused
    std::vector<Peak> peaks;        ///< peaks
    bool device_failed =
        false;  ///< an OpenCL call failed: what this worker does from now on is worth nothing
    bool operator==(const Response&) const = default;
};

/// Of a worker that is at work.
Response progress_response(const std::string& stage, double done);

std::string to_line(const Request& request);
std::string to_line(const Response& response);
/// Throw std::runtime_error on anything that is not a message of this protocol.
Request parse_request(const std::string& line);
Response parse_response(const std::string& line);

}  // namespace ptb
