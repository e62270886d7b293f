#include "bench/worker/paired.h"

#include <algorithm>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/measure/causes.h"

namespace ptb {
namespace {

void no_progress(const Response&) {}

Round round_of(const Record& record) {
    Round round;
    for (const TimeSample& sample : record.samples) {
        round.kernel_ns.push_back(sample.kernel_ns);
        round.host_ns.push_back(sample.host_ns);
    }
    return round;
}

Request round_request(const Case& c) {
    Request request;
    request.kind = Request::Kind::round;
    request.params = c;
    request.samples = round_samples;
    return request;
}

}  // namespace

PairedRun::PairedRun(const DeviceInfo& device, const Side& base, const Side& now, Stopped stopped)
    : base_{base.name, DeviceWorker(device, base.open, base.measure, std::nullopt)},
      now_{now.name, DeviceWorker(device, now.open, now.measure, std::nullopt)},
      timer_(base.measure.timer),
      stopped_(std::move(stopped)) {}

Record PairedRun::validated(Worker& side, const Case& c) {
    Request request;
    request.kind = Request::Kind::run;
    request.params = c;
    Record record = ask(side.worker, request, no_progress);
    if (!side.worker.given_up().empty())
        throw std::runtime_error(fmt::format("{}: {}", side.name, side.worker.given_up()));
    return record;
}

void PairedRun::validate(PairedCase& c) {
    c.base = validated(base_, c.gate.base);
    c.now = validated(now_, c.gate.now);
    c.timer = TimerWatch(timer_);
    observe(c, c.base);
    observe(c, c.now);
    for (const bool now : {false, true}) {
        const Record& record = now ? c.now : c.base;
        const bool valid = record.status == Status::ok || record.status == Status::unstable;
        if (!valid && c.gate.not_measured.empty()) leave_out(c, now, record.reason);
    }
}

void PairedRun::observe(PairedCase& c, const Record& record) {
    for (const TimeSample& sample : record.samples) {
        const std::string fault = sample.cause == cause::timer_fault ? sample.cause : "";
        c.timer.observe({fault, sample.cause == cause::clocks_differ, 0});
    }
    c.gate.timer = c.timer.host() ? "host" : "event";
}

void PairedRun::leave_out(PairedCase& c, bool now_failed, const std::string& reason) {
    c.gate.not_measured = fmt::format("{}: {}", now_failed ? "new" : "base", reason);
    c.gate.without_times = now_failed ? State::missing : State::unmeasured;
    c.gate.screen.clear();
    c.gate.confirm.clear();
}

void PairedRun::add_block(PairedCase& c, std::vector<Block> GateCase::*stage) {
    Block block;
    for (const bool now : {false, true, true, false}) {
        const Record record =
            ask(now ? now_.worker : base_.worker, round_request(now ? c.gate.now : c.gate.base), no_progress);
        const bool complete = static_cast<int>(record.samples.size()) == round_samples;
        if (stopped_()) return;
        if (record.status != Status::ok || !complete) {
            (now ? c.now : c.base) = record;
            return leave_out(c, now, record.reason);
        }
        observe(c, record);
        block.rounds.push_back(round_of(record));
    }
    (c.gate.*stage).push_back(block);
}

void take_blocks(PairedRun& run, const std::vector<PairedCase*>& cases, std::vector<Block> GateCase::*stage,
                 int blocks, std::uint64_t seed, const std::function<void(int done)>& tell) {
    std::mt19937_64 random(seed);
    auto order = cases;
    for (int done = 0; done < blocks; ++done) {
        std::shuffle(order.begin(), order.end(), random);
        for (PairedCase* c : order) {
            if (run.stopped()) return;
            if (c->gate.not_measured.empty()) run.add_block(*c, stage);
        }
        tell(done + 1);
    }
}

}  // namespace ptb
