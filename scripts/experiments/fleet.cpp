// How often a fleet's two stages call a good card slow, and how often they find a slow one, on simulated
// times.
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "bench/fleet/confirm.h"

namespace {

using namespace ptb;

constexpr std::size_t nodes = 100, cards_per_node = 8, cards = nodes * cards_per_node, works = 14;
constexpr double sd = 0.01;  // of each kind of noise, log time

/// What is slow in truth: cards, or whole nodes, by so much.
struct Truth {
    const char* name;
    std::size_t slow_cards = 0, slow_nodes = 0;
    double by = 0;
};

/// A fleet whose cards differ for good, whose sessions differ, and whose cases do; each with Student's tails.
class SimulatedFleet {
  public:
    SimulatedFleet(const Truth& truth, unsigned seed) : random_(seed) {
        for (std::size_t i = 0; i < cards; ++i) {
            nodes_.push_back(fmt::format("n{:03}", i / cards_per_node));
            log_speed_.push_back(noise());
        }
        for (std::size_t i = 0; i < truth.slow_cards; ++i) make_slow(random_() % cards, truth.by);
        for (std::size_t i = 0; i < truth.slow_nodes; ++i) {
            const std::size_t node = random_() % nodes;
            for (std::size_t k = 0; k < cards_per_node; ++k) make_slow(node * cards_per_node + k, truth.by);
        }
    }

    std::vector<double> session(std::size_t card) {
        const double of_session = log_speed_[card] + noise();
        std::vector<double> times;
        for (std::size_t work = 0; work < works; ++work)
            times.push_back(std::log(1e7) + static_cast<double>(work) + of_session + noise());
        return times;
    }

    LogTimes sessions(const std::vector<std::size_t>& of, int each) {
        LogTimes all;
        for (const std::size_t card : of)
            for (int i = 0; i < each; ++i) all.push_back(session(card));
        return all;
    }

    const std::vector<std::string>& node_of_card() const { return nodes_; }
    const std::set<std::size_t>& slow() const { return slow_; }
    /// Whether to call it slow is wrong; the tail of good cards has some that are.
    bool is_good(std::size_t card) const { return log_speed_[card] <= std::log1p(slow_by); }

  private:
    double noise() { return sd * tails_(random_) / std::sqrt(5.0 / 3); }
    void make_slow(std::size_t card, double by) {
        if (slow_.insert(card).second) log_speed_[card] += std::log1p(by);
    }

    std::mt19937 random_;
    std::student_t_distribution<> tails_{5};
    std::vector<std::string> nodes_;
    std::vector<double> log_speed_;
    std::set<std::size_t> slow_;
};

/// Cards that are called slow, as `ptbench --fleet` with `--confirm` finds them.
std::set<std::size_t> called_slow(SimulatedFleet& fleet, unsigned seed) {
    LogTimes screened;
    for (std::size_t card = 0; card < cards; ++card) screened.push_back(fleet.session(card));
    const Screened first = screen(screened, fleet.node_of_card());
    const LogTimes controls =
        fleet.sessions(controls_of(first, fleet.node_of_card(), seed), confirm_sessions);
    std::vector<std::vector<double>> deviations;
    for (const std::size_t card : first.candidates)
        deviations.push_back(session_deviations(fleet.sessions({card}, confirm_sessions), controls));
    const std::vector<Confirmed> found = confirmed(deviations);
    std::set<std::size_t> slow;
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i].speed == Speed::slow) slow.insert(first.candidates[i]);
    return slow;
}

void simulate(const Truth& truth, int runs, unsigned seed) {
    int alarms = 0;
    std::size_t found = 0, planted = 0;
    for (int run = 0; run < runs; ++run) {
        SimulatedFleet fleet(truth, seed + static_cast<unsigned>(run));
        const std::set<std::size_t> slow = called_slow(fleet, seed);
        bool alarm = false;
        for (const std::size_t card : slow) {
            found += fleet.slow().contains(card) ? 1 : 0;
            alarm = alarm || fleet.is_good(card);
        }
        alarms += alarm ? 1 : 0;
        planted += fleet.slow().size();
    }
    fmt::print("| {} | {} of {} | {} |\n", truth.name, alarms, runs,
               planted == 0 ? "-" : fmt::format("{:.1f} %", 100 * double(found) / double(planted)));
}

}  // namespace

int main(int argc, char** argv) {
    const auto seed = static_cast<unsigned>(argc > 1 ? std::atoi(argv[1]) : 1);
    const int runs = argc > 2 ? std::atoi(argv[2]) : 200;
    fmt::print("| 800 cards | runs with a false alarm | slow cards found |\n| --- | ---: | ---: |\n");
    for (const Truth& truth :
         {Truth{"all good"}, Truth{"1 card 10 % slow", 1, 0, 0.10}, Truth{"80 cards 10 % slow", 80, 0, 0.10},
          Truth{"2 nodes 10 % slow", 0, 2, 0.10}, Truth{"1 card 6 % slow", 1, 0, 0.06}})
        simulate(truth, runs, seed);
}
