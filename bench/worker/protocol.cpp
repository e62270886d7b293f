#include "bench/worker/protocol.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "bench/record/film_json.h"
#include "bench/record/parts_json.h"

namespace ptb {
namespace {

constexpr const char* request_kinds[] = {"open",   "estimate", "run",           "round",        "peaks",
                                         "render", "stop",     "share_picture", "render_parts", "give_film"};
constexpr const char* response_kinds[] = {"ready",   "estimate", "progress",   "record",
                                          "failed",  "peaks",    "pixels",     "rendered",
                                          "refused", "sharing",  "parts_done", "film_given"};

template <class Kind, std::size_t N>
Kind parse_kind(const Json& json, const Where& where, const char* const (&words)[N]) {
    for (std::size_t i = 0; i < N; ++i)
        if (json == words[i]) return static_cast<Kind>(i);
    where.fail("is not a message of the worker protocol");
}

}  // namespace

Json encode(Request::Kind kind) { return request_kinds[static_cast<std::size_t>(kind)]; }
Json encode(Response::Kind kind) { return response_kinds[static_cast<std::size_t>(kind)]; }
void decode(const Json& json, const Where& where, Request::Kind& kind) {
    kind = parse_kind<Request::Kind>(json, where, request_kinds);
}
void decode(const Json& json, const Where& where, Response::Kind& kind) {
    kind = parse_kind<Response::Kind>(json, where, response_kinds);
}

Json encode(Aov aov) { return aov_names[static_cast<std::size_t>(aov)]; }
void decode(const Json& json, const Where& where, Aov& aov) {
    const auto found = std::find(aov_names.begin(), aov_names.end(), json);
    if (found == aov_names.end()) where.fail("is not a message of the worker protocol");
    aov = static_cast<Aov>(found - aov_names.begin());
}

Json encode(const WorkerFacts& facts) { return facts.facts; }
void decode(const Json& json, const Where& where, WorkerFacts& facts) {
    if (!json.is_object()) where.refuse(json, "an object");
    for (const auto& [name, value] : json.items()) decode(value, Where(where, name), facts.facts[name]);
}

template <>
inline constexpr auto fields<Request> = std::make_tuple(
    required("kind", &Request::kind), required("protocol", &Request::protocol),
    field("number", &Request::number), field("measure", &Request::measure), field("params", &Request::params),
    field("time_left_s", &Request::time_left_s), field("scene_hash", &Request::scene_hash),
    field("picture", &Request::picture), field("validate_only", &Request::validate_only),
    field("beside_others", &Request::beside_others), field("samples", &Request::samples),
    field("time_s", &Request::time_s), field("aov", &Request::aov), field("cut", &Request::cut),
    field("parts", &Request::parts), field("film_file", &Request::film_file));

template <>
inline constexpr auto fields<Response> = std::make_tuple(
    required("kind", &Response::kind), required("protocol", &Response::protocol),
    field("number", &Response::number), field("worker", &Response::worker), field("facts", &Response::facts),
    field("ns_per_sample", &Response::ns_per_sample), field("stage", &Response::stage),
    field("done", &Response::done), field("record", &Response::record),
    field("first_row", &Response::first_row), field("rgb", &Response::rgb), field("whole", &Response::whole),
    field("spp", &Response::spp), field("seconds", &Response::seconds), field("reason", &Response::reason),
    field("device_failed", &Response::device_failed), field("peaks", &Response::peaks),
    field("cut", &Response::cut), field("part_count", &Response::part_count),
    field("parts", &Response::parts), field("device_s", &Response::device_s), field("film", &Response::film));

namespace {

bool of_a_case(const Request& request) {
    using Kind = Request::Kind;
    constexpr Kind others[] = {Kind::open, Kind::peaks, Kind::stop, Kind::render_parts, Kind::give_film};
    return std::find(std::begin(others), std::end(others), request.kind) == std::end(others);
}

template <class Message>
Message parse_message(const std::string& line) {
    Message message;
    const std::string origin = "message";
    decode(parse_json(line, origin), Where(origin), message);
    return message;
}

}  // namespace

Response progress_response(const std::string& stage, double done) {
    Response response;
    response.kind = Response::Kind::progress;
    response.stage = stage;
    response.done = done;
    return response;
}

std::string to_line(const Request& request) {
    Json json = encode(request);
    if (!of_a_case(request)) json.erase("params");
    return dump_json(json) + "\n";
}

std::string to_line(const Response& response) { return dump_json(encode(response)) + "\n"; }

Request parse_request(const std::string& line) {
    const auto request = parse_message<Request>(line);
    if (of_a_case(request) && request.params.kernel.empty())
        throw std::runtime_error("message: \"params\" is missing");
    return request;
}

Response parse_response(const std::string& line) {
    const auto response = parse_message<Response>(line);
    if (response.kind == Response::Kind::record && !response.record)
        throw std::runtime_error("message: \"record\" is missing");
    return response;
}

}  // namespace ptb
