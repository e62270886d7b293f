#include "bench/report/race.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/measure/statistics.h"
#include "bench/plan/tuned.h"
#include "bench/record/status.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

std::string percent_slower(double log_ratio) { return fmt::format("{:+.1f} %", 100 * std::expm1(log_ratio)); }

std::string word(const Race& race, std::size_t i) {
    if (i == race.leader) return "best";
    const Runner::State state = race.runners[i].state;
    return state == Runner::State::tied ? "tie" : state == Runner::State::slower ? "slower" : "failed";
}

/// Of those who ran to the end: others' times are of another while, and only their ratios mean something.
std::string median_text(const Runner& runner) {
    if (runner.state != Runner::State::tied) return "-";
    auto times = runner.times;
    std::sort(times.begin(), times.end());
    return number_text(ms(quantile(times, 0.5)));
}

std::vector<std::string> cells(const Contest& contest, std::size_t i) {
    const Runner& runner = contest.race.runners[i];
    const Case& c = contest.records[contest.raced[i]].params;
    const bool compared = runner.state != Runner::State::failed && i != contest.race.leader;
    return {case_value(c, "lanes"),
            to_string(c.work_group),
            median_text(runner),
            compared ? percent_slower(runner.slower) : "-",
            compared && runner.state == Runner::State::tied ? percent_slower(runner.bound) : "-",
            std::to_string(runner.times.size()),
            word(contest.race, i)};
}

/// By state, then by distance from the best.
std::vector<std::size_t> ranking(const Race& race) {
    std::vector<std::size_t> order(race.runners.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
        const Runner &one = race.runners[a], &other = race.runners[b];
        return std::pair(one.state, one.slower) < std::pair(other.state, other.slower);
    });
    return order;
}

/// What tuning gained over what would be taken without it.
std::string gain(const Contest& contest, int usual_lanes) {
    for (std::size_t i = 0; i < contest.raced.size(); ++i) {
        const Case& c = contest.records[contest.raced[i]].params;
        const Runner& runner = contest.race.runners[i];
        if (!c.work_group.implicit() || (c.lanes != usual_lanes && c.lanes != 0)) continue;
        if (runner.state == Runner::State::failed) break;
        return fmt::format(
            "untuned, {} is taken: {}", launch_text(c),
            runner.state == Runner::State::tied ? "it is among the best" : percent_slower(runner.slower));
    }
    return "";
}

}  // namespace

Section race_section(const Contest& contest, const std::string& title, int usual_lanes) {
    Section section;
    section.title = title;
    section.grid.columns = {{"lanes", true, 0},     {"work-group", false, 0}, {"median ms", true, 0},
                            {"slower by", true, 0}, {"at most", true, 0},     {"n", true, 0},
                            {"state", false, 0}};
    for (const std::size_t i : ranking(contest.race)) section.grid.rows.push_back(cells(contest, i));
    std::size_t unsupported = 0;
    for (const Record& record : contest.records) {
        unsupported += record.status == Status::unsupported ? 1 : 0;
        if (record.status == Status::unsupported || record.reason.empty()) continue;
        section.notes.push_back(
            fmt::format("{}: {}: {}", launch_text(record.params), to_string(record.status), record.reason));
    }
    if (unsupported > 0)
        section.notes.push_back(fmt::format("{} candidates are unsupported here", unsupported));
    if (!contest.race.settled && contest.race.leader)
        section.notes.emplace_back("too noisy to tell all ties within 2 %: `ptbench doctor` says why");
    if (const auto line = gain(contest, usual_lanes); !line.empty()) section.notes.push_back(line);
    return section;
}

}  // namespace ptb
