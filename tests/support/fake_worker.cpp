// A worker that speaks the protocol without OpenCL and misbehaves on demand. FAKE_PROBE and FAKE_OPEN say how
// it answers `--probe` and `open`; the scene of a case says how it answers `run`; FAKE_NS is its estimate.
// What a behaviour means is the table in `misbehave`.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include <signal.h>
#include <unistd.h>

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

Response progress(double done) {
    Response response;
    response.kind = Response::Kind::progress;
    response.stage = "sample";
    response.done = done;
    return response;
}

/// Takes longer than a test's timeout, but is never silent for as long.
void be_slow() {
    for (int i = 0; i < 10; ++i) {
        say(to_line(progress(i / 10.0)));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
}

void answer_open() {
    const std::string how = variable("FAKE_OPEN");
    misbehave(how);
    Response response;
    response.tool_version = "0.0";
    if (how == "refuse-protocol") response.protocol = protocol_version - 1;
    if (how.starts_with("refuse")) {
        response.kind = Response::Kind::failed;
        response.reason = "no such device";
    }
    if (how == "other-protocol") response.protocol = protocol_version + 1;
    say(to_line(response));
}

void answer_estimate(const Request& request) {
    misbehave(request.params.scene == "bad-estimate" ? "abort" : "");
    Response response;
    response.kind = Response::Kind::estimate;
    const std::string ns = variable("FAKE_NS");
    response.ns_per_sample = ns.empty() ? 1000 : std::stod(ns);
    say(to_line(response));
}

void answer_run(const Request& request) {
    misbehave(request.params.scene);
    if (request.params.scene == "slow") be_slow();
    Response response;
    response.kind = Response::Kind::record;
    response.record.emplace();
    response.record->params = request.params;
    response.record->status = request.params.scene == "unstable"  ? Status::unstable
                              : request.params.scene == "invalid" ? Status::invalid
                                                                  : Status::ok;
    response.record->statistics.emplace();
    response.record->statistics->n = ::getpid();  // lets a test see which process answered
    response.record->statistics->max_ns = request.time_left_s.value_or(-1);
    response.record->statistics->timer_reason = request.image_file;
    if (request.params.scene.ends_with("by-host")) response.record->statistics->timer = "host";
    say(to_line(response));
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
    response.record->samples.assign(static_cast<std::size_t>(request.samples), sample);
    say(to_line(response));
}

void answer(const Request& request) {
    switch (request.kind) {
        case Request::Kind::open:
            return answer_open();
        case Request::Kind::estimate:
            return answer_estimate(request);
        case Request::Kind::run:
            return answer_run(request);
        case Request::Kind::round:
            return answer_round(request);
    }
}

int answer_probe() {
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
    if (argc > 2 && std::string(argv[2]) == "--probe") return answer_probe();
    for (std::string line; std::getline(std::cin, line);) answer(parse_request(line));
    return 0;
}
