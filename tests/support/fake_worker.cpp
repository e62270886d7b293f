// A worker that speaks the protocol without OpenCL and misbehaves on demand. FAKE_PROBE and FAKE_OPEN say how
// it answers `--probe` and `open`; the scene of a case says how it answers `run`; FAKE_NS is its estimate.
// What a behaviour means is the table in `misbehave`. Unlike a real one it stays when its stdin ends while it
// hangs.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include <signal.h>
#include <unistd.h>

#include "bench/worker/picture.h"
#include "bench/worker/probe.h"
#include "bench/worker/protocol.h"

namespace {

using namespace ptb;

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? std::string() : std::string(value);
}

void say(const std::string& line) {
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
}

/// What follows `flag` in the command line.
std::string value_of(const std::string& flag, int argc, char** argv) {
    for (int i = 1; i + 1 < argc; ++i)
        if (argv[i] == flag) return argv[i + 1];
    return {};
}

/// Who answers, and the request being answered.
struct Answering {
    WorkerIdentity worker;
    std::int64_t number = 0;
} answering;

void answer_with(Response response) {
    response.worker = answering.worker;
    response.number = answering.number;
    say(to_line(response));
}

void misbehave(const std::string& how) {
    if (how == "sigkill") ::raise(SIGKILL);
    if (how == "abort") {
        std::fputs("first line\nassertion failed: !device->lost\n", stderr);
        std::abort();
    }
    if (how == "exit") std::_Exit(3);
    if (how == "hang") std::this_thread::sleep_for(std::chrono::hours(1));
    if (how == "garbage") say("Segmentation fault (core dumped)\n");
    if (how == "mutter") std::fputs("warning: this driver is old\n", stderr);
    if (how == "orphan") {  // dies while a child of its own keeps the pipes open
        if (::fork() == 0) std::this_thread::sleep_for(std::chrono::hours(1));
        std::_Exit(4);
    }
}

/// Takes longer than a test's timeout, but is never silent for as long.
void be_slow() {
    for (int i = 0; i < 10; ++i) {
        answer_with(progress_response("sample", i / 10.0));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

void answer_open(const Request& request) {
    const std::string how = variable("FAKE_OPEN");
    answer_with(progress_response("open", 0));
    misbehave(how);
    Response response;
    response.facts = facts_here(request.measure.kernel_dir);
    if (how == "other-build") response.facts.facts["ptbench"] = "0.0 of long ago";
    if (how == "other-kernel") response.facts.facts["kernel pt"] = "0123456789abcdef";
    if (how == "refuse-protocol") response.protocol = protocol_version - 1;
    if (how.starts_with("refuse")) {
        response.kind = Response::Kind::failed;
        response.reason = "no such device";
    }
    if (how == "other-protocol") response.protocol = protocol_version + 1;
    answer_with(response);
}

void answer_estimate(const Request& request) {
    misbehave(request.params.scene == "bad-estimate" ? "abort" : "");
    Response response;
    response.kind = Response::Kind::estimate;
    const std::string ns = variable("FAKE_NS");
    response.ns_per_sample = ns.empty() ? 1000 : std::stod(ns);
    answer_with(response);
}

/// A picture whose every number is the case's SPP; half of it in the scene "torn-picture".
void send_picture(const Case& c) {
    Image image{c.size, std::vector<float>(3 * c.size.pixels(), static_cast<float>(c.spp))};
    if (c.scene == "torn-picture") image.size.height /= 2;
    send_rows(image, [](int first_row, const std::string& rgb) {
        Response response;
        response.kind = Response::Kind::pixels;
        response.first_row = first_row;
        response.rgb = rgb;
        answer_with(response);
    });
}

void answer_run(const Request& request) {
    misbehave(request.params.scene);
    if (request.params.scene == "slow") be_slow();
    if (request.params.scene == "stale") --answering.number;
    if (request.picture) send_picture(request.params);
    Response response;
    response.kind = Response::Kind::record;
    response.record.emplace();
    response.record->params = request.params;
    response.record->status = request.params.scene == "unstable"  ? Status::unstable
                              : request.params.scene == "invalid" ? Status::invalid
                                                                  : Status::ok;
    if (request.params.scene == "mutter") response.record->build.emplace();
    response.record->statistics.emplace();
    response.record->statistics->n = ::getpid();  // lets a test see which process answered
    response.record->statistics->median_ns = 1e5;
    response.record->statistics->max_ns = request.time_left_s.value_or(-1);
    response.record->work.emplace();
    response.record->work->segments = 1;
    if (request.params.scene == "other-case") ++response.record->params.spp;
    if (request.params.scene.ends_with("by-host")) response.record->statistics->timer = "host";
    answer_with(response);
}

/// Each sample takes 1 ms by the device's clock, 2 % more in the scene "slower"; some by no clock at all.
void answer_round(const Request& request) {
    const std::string& scene = request.params.scene;
    misbehave(scene == "dies-in-a-round" ? "abort" : "");
    Response response;
    response.kind = Response::Kind::record;
    response.record.emplace();
    response.record->params = request.params;
    response.record->status = scene == "wrong-in-a-round" ? Status::invalid : Status::ok;
    TimeSample sample;
    sample.kernel_ns = scene == "slower" ? 1'020'000 : 1'000'000;
    sample.host_ns = 3'000'000;
    if (scene == "slow-by-host") sample.host_ns = 6'000'000;
    if (scene == "faulty-timer") sample.cause = "timer_fault";
    if (scene == "clocks-differ") sample.cause = "clocks_differ";
    response.record->samples.assign(static_cast<std::size_t>(request.samples), sample);
    if (scene == "disturbed-once") response.record->samples.front().cause = "clocks_differ";
    answer_with(response);
}

void answer_peaks() {
    misbehave(variable("FAKE_PEAKS"));
    Response response;
    response.kind = Response::Kind::peaks;
    response.peaks = {{"fma", "GFLOP/s", 100, 99, 101, 10, "event", ""}};
    answer_with(response);
}

void answer(const Request& request) {
    switch (request.kind) {
        case Request::Kind::open:
            return answer_open(request);
        case Request::Kind::estimate:
            return answer_estimate(request);
        case Request::Kind::run:
            return answer_run(request);
        case Request::Kind::round:
            return answer_round(request);
        case Request::Kind::peaks:
            return answer_peaks();
        case Request::Kind::render:
        case Request::Kind::stop:
        case Request::Kind::share_picture:
        case Request::Kind::render_parts:
        case Request::Kind::give_film:
            return;
    }
}

int answer_probe() {
    say(started_line(answering.worker));
    misbehave(variable("FAKE_PROBE"));
    DeviceInfo device;
    device.key = "fake:0";
    device.name = variable("OCL_ICD_VENDORS");  // lets a test see which drivers this process may load
    device.vendor = "nobody";
    device.type = "CPU";
    say(variable("FAKE_PROBE") == "error" ? probe_error_line("CL_OUT_OF_HOST_MEMORY") : probe_line({device}));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    answering.worker = this_worker(value_of("--nonce", argc, argv));
    if (argc > 2 && std::string(argv[2]) == "--probe") return answer_probe();
    for (std::string line; std::getline(std::cin, line);) {
        const Request request = parse_request(line);
        answering.number = request.number;
        answer(request);
    }
    return 0;
}
