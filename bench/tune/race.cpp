#include "bench/tune/race.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <random>

#include <boost/math/distributions/students_t.hpp>

#include "bench/compare/evidence.h"

namespace ptb {
namespace {

using Running = std::vector<std::size_t>;

double mean_log(const Runner& runner) {
    double sum = 0;
    for (const double time : runner.times) sum += std::log(time);
    return sum / static_cast<double>(runner.times.size());
}

/// Mean log ratio to the leader, and how far off the truth may be.
struct Gap {
    double mean, reach;
};

Gap gap(const Runner& runner, const Runner& leader, double level) {
    std::vector<double> d;
    for (std::size_t i = 0; i < runner.times.size(); ++i)
        d.push_back(std::log(runner.times[i] / leader.times[i]));
    const double n = static_cast<double>(d.size());
    const auto [mean, sd] = moments(d);
    const boost::math::students_t t(n - 1);
    return {mean, boost::math::quantile(boost::math::complement(t, level)) * sd / std::sqrt(n)};
}

/// One sample of each, in shuffled order; who fails leaves.
void run_round(Race& race, Running& running, std::mt19937_64& random, const TakeTime& take) {
    std::shuffle(running.begin(), running.end(), random);
    for (const std::size_t i : running) {
        const auto time = take(i);
        if (time)
            race.runners[i].times.push_back(*time);
        else
            race.runners[i].state = Runner::State::failed;
    }
    std::erase_if(running, [&](auto i) { return race.runners[i].state == Runner::State::failed; });
}

/// Compares all that run with the leader, and drops who is slower.
void look(Race& race, Running& running, const RaceRules& rules, double level) {
    race.leader = *std::min_element(running.begin(), running.end(), [&](auto a, auto b) {
        return mean_log(race.runners[a]) < mean_log(race.runners[b]);
    });
    race.settled = true;
    for (const std::size_t i : running) {
        if (i == race.leader) continue;
        Runner& runner = race.runners[i];
        const auto [mean, reach] = gap(runner, race.runners[*race.leader], level);
        runner.slower = mean;
        runner.bound = mean + reach;
        if (mean - reach > 0)
            runner.state = Runner::State::slower;
        else
            race.settled &= runner.bound < std::log1p(rules.tie);
    }
    race.runners[*race.leader].slower = race.runners[*race.leader].bound = 0;
    std::erase_if(running, [&](auto i) { return race.runners[i].state == Runner::State::slower; });
}

}  // namespace

Race race(std::size_t candidates, const RaceRules& rules, const TakeTime& take) {
    Race race;
    race.runners.resize(candidates);
    Running running(candidates);
    std::iota(running.begin(), running.end(), 0u);
    std::mt19937_64 random(rules.seed);
    const double level =
        rules.alpha / static_cast<double>(std::size(looks) * std::max<std::size_t>(candidates - 1, 1));
    int taken = 0;
    for (const int at : looks) {
        for (; taken < at; ++taken) run_round(race, running, random, take);
        if (running.empty()) return race;
        look(race, running, rules, level);
        if (race.settled) break;
    }
    return race;
}

}  // namespace ptb
