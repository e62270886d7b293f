#include "bench/tune/contest.h"

#include <algorithm>

#include <fmt/format.h>

namespace ptb {
namespace {

Request request(Request::Kind kind, const Case& c) {
    Request request;
    request.kind = kind;
    request.params = c;
    request.samples = 1;
    return request;
}

/// One busy moment lets a sample's clocks disagree; a faulty timer shows in most candidates.
std::string timer_of(const Contest& contest) {
    const auto by_host = std::count_if(contest.raced.begin(), contest.raced.end(), [&](auto i) {
        return contest.records[i].statistics && contest.records[i].statistics->timer == "host";
    });
    return 2 * by_host > static_cast<std::ptrdiff_t>(contest.raced.size()) ? "host" : "event";
}

std::optional<double> time_of(const Record& record, const std::string& timer) {
    if (record.status != Status::ok || record.samples.empty()) return std::nullopt;
    const TimeSample& sample = record.samples.front();
    const std::int64_t ns = timer == "host" ? sample.host_ns : sample.kernel_ns;
    return ns > 0 ? std::optional(static_cast<double>(ns)) : std::nullopt;
}

}  // namespace

bool Contest::valid(std::size_t candidate) const {
    const Status status = records[candidate].status;
    return status == Status::ok || status == Status::unstable;
}

Contest hold_contest(DeviceWorker& worker, const std::vector<Case>& candidates, const RaceRules& rules,
                     const Stopped& stopped, const std::function<void(const std::string&)>& tell) {
    const auto no_progress = [](const Response&) {};
    Contest contest;
    tell(fmt::format("validating {} candidates", candidates.size()));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        contest.records.push_back(ask(worker, request(Request::Kind::run, candidates[i]), no_progress));
        if (contest.valid(i)) contest.raced.push_back(i);
    }
    contest.timer = timer_of(contest);
    tell(fmt::format("racing {} of them", contest.raced.size()));
    contest.race = race(contest.raced.size(), rules, [&](std::size_t runner) -> std::optional<double> {
        if (stopped()) return std::nullopt;
        const std::size_t i = contest.raced[runner];
        const Record record = ask(worker, request(Request::Kind::round, candidates[i]), no_progress);
        const auto time = time_of(record, contest.timer);
        if (!time) contest.records[i] = record;
        return time;
    });
    return contest;
}

}  // namespace ptb
