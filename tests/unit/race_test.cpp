#include "bench/tune/race.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace ptb {
namespace {

using State = Runner::State;

/// Twelve candidates, the best first, that a race over work-groups and lane widths may have.
const std::vector<double> truth{1, 1.005, 1.01, 1.03, 1.05, 1.08, 1.12, 1.2, 1.3, 1.5, 2, 4};

/// Truth with noise on it; what was taken of it adds up.
struct Source {
    std::vector<double> truth;
    double noise;
    unsigned seed;
    double cost = 0;

    Race run() {
        std::mt19937 random(seed);
        std::normal_distribution<> log_noise(0, noise);
        return race(truth.size(), {}, [&](std::size_t i) {
            cost += truth[i];
            return truth[i] * std::exp(log_noise(random));
        });
    }
    double cost_of_all(const Race& race) const {
        double sum = 0;
        for (const double time : truth) sum += time;
        return sum * static_cast<double>(race.runners[*race.leader].times.size());
    }
};

std::vector<State> states(const Race& race) {
    std::vector<State> states;
    for (const Runner& runner : race.runners) states.push_back(runner.state);
    return states;
}

TEST(race, finds_one_within_2_percent_of_the_best_in_95_of_100_trials_at_half_the_cost_of_trying_all) {
    for (const double noise : {0.01, 0.02, 0.05}) {
        int good = 0;
        double cost = 0, cost_of_all = 0;
        for (unsigned trial = 0; trial < 100; ++trial) {
            Source source{truth, noise, trial};
            const Race race = source.run();
            good += truth[*race.leader] <= 1.02 * truth[0] ? 1 : 0;
            cost += source.cost;
            cost_of_all += source.cost_of_all(race);
        }
        EXPECT_GE(good, 95) << "noise " << noise;
        EXPECT_LE(cost, 0.5 * cost_of_all) << "noise " << noise;
    }
}

TEST(race, the_best_is_among_the_ties_in_95_of_100_trials) {
    for (const auto& candidates : {truth, std::vector<double>(8, 1.0)}) {
        int kept = 0;
        for (unsigned trial = 0; trial < 100; ++trial)
            kept += Source{candidates, 0.02, trial}.run().runners[0].state == State::tied ? 1 : 0;
        EXPECT_GE(kept, 95);
    }
}

TEST(race, who_is_far_behind_is_dropped_at_the_first_look) {
    const Race race = Source{{1, 1, 3}, 0.01, 1}.run();
    EXPECT_EQ(race.runners[2].times.size(), std::size_t{looks[0]});
    EXPECT_EQ(states(race), (std::vector{State::tied, State::tied, State::slower}));
    EXPECT_NEAR(race.runners[2].slower, std::log(3), 0.05);
}

TEST(race, ends_when_all_that_are_left_are_as_good_as_the_leader) {
    const Race quiet = Source{{1, 1.001}, 0.001, 1}.run();
    EXPECT_TRUE(quiet.settled);
    EXPECT_LT(quiet.runners[0].times.size(), std::size_t{8});
    const Race noisy = Source{{1, 1.001}, 0.2, 1}.run();
    EXPECT_FALSE(noisy.settled);
    EXPECT_EQ(noisy.runners[0].times.size(), std::size_t{*std::rbegin(looks)});
}

TEST(race, drift_and_bursts_meet_all_alike) {
    std::mt19937 random(1);
    double now = 1;
    const Race run = race(3, {}, [&](std::size_t i) {
        now *= 1.002 * (random() % 10 == 0 ? 1.5 : 1) / (now > 2 ? now : 1);
        return now * (i == 1 ? 1.0 : 1.5);
    });
    EXPECT_EQ(run.leader, 1u);
}

TEST(race, who_fails_leaves_and_does_not_win) {
    const Race run = race(3, {}, [](std::size_t i) -> std::optional<double> {
        if (i == 0) return std::nullopt;
        return i == 1 ? 2.0 : 1.0;
    });
    EXPECT_EQ(states(run), (std::vector{State::failed, State::slower, State::tied}));
    EXPECT_EQ(run.leader, 2u);
    EXPECT_FALSE(race(1, {}, [](std::size_t) { return std::nullopt; }).leader);
}

TEST(race, every_round_has_an_order_of_its_own) {
    std::vector<std::size_t> order;
    race(8, {}, [&](std::size_t i) {
        order.push_back(i);
        return 1.0;
    });
    ASSERT_EQ(order.size(), 8u * looks[0]);
    EXPECT_FALSE(std::equal(order.begin(), order.begin() + 8, order.begin() + 8));
}

}  // namespace
}  // namespace ptb
