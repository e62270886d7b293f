#include "bench/worker/protocol.h"

#include <stdexcept>

#include <gmock/gmock.h>

namespace ptb {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

Request run_request() {
    Request request;
    request.kind = Request::Kind::run;
    request.params = {"pocl:0", "pt", "thesis", {64, 32}, 4, 5, {16, 16}, 8};
    request.time_left_s = 1.5;
    request.number = 7;
    request.scene_hash = "9f86d081884c7d65";
    request.picture = true;
    return request;
}

TEST(Protocol, requests_survive_the_line) {
    Request open;
    open.measure = {7, 0, 3, 30, 2.5, "host", true, "kernels"};
    Request estimate = run_request();
    estimate.kind = Request::Kind::estimate;
    estimate.time_left_s.reset();
    Request peaks, render = run_request(), stop;
    peaks.kind = Request::Kind::peaks;
    render.kind = Request::Kind::render;
    stop.kind = Request::Kind::stop;
    stop.number = 7;
    Request share = run_request(), parts, film;
    share.kind = Request::Kind::share_picture;
    share.cut = RunCut{21, 512};
    share.film_file = "/proc/7/fd/3";
    parts.kind = Request::Kind::render_parts;
    parts.parts = {1'000'000'000'000, 1'000'000'000'007};
    film.kind = Request::Kind::give_film;
    for (const Request& request : {open, run_request(), estimate, peaks, render, stop, share, parts, film}) {
        const auto line = to_line(request);
        EXPECT_THAT(line, EndsWith("}\n"));
        EXPECT_EQ(line.find('\n'), line.size() - 1) << "a message is one line";
        EXPECT_EQ(parse_request(line), request);
        EXPECT_EQ(parse_request(line.substr(0, line.size() - 1)), request);
    }
}

TEST(Protocol, responses_survive_the_line) {
    Response ready, progress, failed, done;
    ready.number = 7;
    ready.worker = {"5f", "node \"7\"", 1234567890123, "a0"};
    ready.facts.facts = {{"ptbench", "0.1.0 4fd1c2"}, {"kernel pt", "9f86d081884c7d65"}};
    progress.kind = Response::Kind::progress;
    progress.stage = "sample";
    progress.done = 0.25;
    failed.kind = Response::Kind::failed;
    failed.reason = "no such device";
    done.kind = Response::Kind::record;
    done.record = Record{run_request().params, Status::crash, "SIGSEGV (11)", {}, {}, {}, {}, {}, {}, {}, {}};
    Response estimate;
    estimate.kind = Response::Kind::estimate;
    estimate.ns_per_sample = 12.75;
    Response peaks;
    peaks.kind = Response::Kind::peaks;
    peaks.peaks = {{"fma", "GFLOP/s", 100, 99, 101, 10, "event", ""}, {"sqrt", "", {}, {}, {}, 0, "", "no"}};
    Response pixels, rendered, refused, given;
    given.kind = Response::Kind::film_given;
    given.film = FilmFacts{{640, 480}, {24, -3}, true, 7};
    pixels.kind = Response::Kind::pixels;
    pixels.first_row = 12;
    pixels.rgb = "AAAA";
    rendered.kind = Response::Kind::rendered;
    rendered.whole = true;
    refused.kind = Response::Kind::refused;
    refused.reason = "too large";
    for (const Response& response :
         {ready, progress, failed, done, estimate, peaks, pixels, rendered, refused, given})
        EXPECT_EQ(parse_response(to_line(response)), response);
}

TEST(Protocol, what_is_no_message_is_refused) {
    for (const char* line :
         {"", "\n", "{}", "[]", "null", "hello", "{\"kind\":\"open\"}", "{\"kind\":\"sing\",\"protocol\":1}",
          "{\"kind\":1,\"protocol\":1}", "{\"kind\":\"run\",\"protocol\":1}",
          "{\"kind\":\"record\",\"protocol\":1}", "{\"kind\":\"record\",\"protocol\":1,\"record\":null}",
          "{\"kind\":\"open\",\"protocol\":\"1\"}", "\xff\xfe"}) {
        EXPECT_THROW(parse_request(line), std::runtime_error) << line;
        EXPECT_THROW(parse_response(line), std::runtime_error) << line;
    }
}

TEST(Protocol, another_version_can_be_told) {
    Response ready;
    ready.protocol = 99;
    EXPECT_EQ(parse_response(to_line(ready)).protocol, 99);
}

TEST(Protocol, bytes_that_are_not_utf8_are_replaced) {
    Response failed;
    failed.kind = Response::Kind::failed;
    failed.reason = "bad \xff byte";
    EXPECT_EQ(parse_response(to_line(failed)).reason, "bad \xEF\xBF\xBD byte");
}

}  // namespace
}  // namespace ptb
