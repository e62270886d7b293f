#include "bench/worker/protocol.h"

#include <iterator>
#include <stdexcept>

#include "bench/record/json.h"

namespace ptb {
namespace {

constexpr const char* request_kinds[] = {"open", "estimate", "run", "round", "peaks"};
constexpr const char* response_kinds[] = {"ready", "estimate", "progress", "record", "failed", "peaks"};

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

template <>
inline constexpr auto fields<Request> = std::make_tuple(required("kind", &Request::kind),
                                                        required("protocol", &Request::protocol),
                                                        field("measure", &Request::measure),
                                                        field("params", &Request::params),
                                                        field("time_left_s", &Request::time_left_s),
                                                        field("image_file", &Request::image_file),
                                                        field("samples", &Request::samples));

template <>
inline constexpr auto fields<Response> = std::make_tuple(
    required("kind", &Response::kind), required("protocol", &Response::protocol),
    field("tool_version", &Response::tool_version), field("ns_per_sample", &Response::ns_per_sample),
    field("stage", &Response::stage), field("done", &Response::done), field("record", &Response::record),
    field("reason", &Response::reason), field("device_failed", &Response::device_failed),
    field("peaks", &Response::peaks));

namespace {

bool of_a_case(const Request& request) {
    return request.kind != Request::Kind::open && request.kind != Request::Kind::peaks;
}

template <class Message>
Message parse_message(const std::string& line) {
    Message message;
    const std::string origin = "message";
    decode(parse_json(line, origin), Where(origin), message);
    return message;
}

}  // namespace

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
