// The race of `ptbench tune` on simulated timings, beside giving every candidate the samples that the leader
// got.
#include "bench/tune/race.h"

#include <cstdlib>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "scripts/experiments/machine.h"

namespace {

using namespace ptb;

constexpr int trials = 400;
constexpr double as_good = 1.02;

/// True times, the best first.
struct Field {
    const char* name;
    std::vector<double> times;
};

const Field fields[] = {
    {"12, spread from 0 to 300 %", {1, 1.005, 1.01, 1.03, 1.05, 1.08, 1.12, 1.2, 1.3, 1.5, 2, 4}},
    {"20, as `pt` on PoCL: 4 lane widths",
     {1, 1.003, 1.01, 1.02, 1.02, 1.2, 1.2, 1.21, 1.22, 1.23, 1.9, 1.9, 1.92, 1.95, 2, 9, 9, 9.1, 9.2, 9.5}},
    {"14, even from 0 to 20 %",
     {1, 1.01, 1.02, 1.03, 1.04, 1.05, 1.06, 1.08, 1.1, 1.12, 1.14, 1.16, 1.18, 1.2}},
    {"8, one 2.5 % before all others", {1, 1.025, 1.025, 1.025, 1.025, 1.025, 1.025, 1.025}},
    {"8, all equal", std::vector<double>(8, 1.0)},
};

struct Tally {
    int good = 0, best_dropped = 0, ties = 0;
    double cost = 0, cost_of_all = 0, samples = 0;
};

void add_trial(const Field& field, double noise, unsigned seed, Tally& tally) {
    Machine machine(noise, 400, seed);
    const Race result = race(field.times.size(), {.seed = seed}, [&](std::size_t i) {
        tally.cost += field.times[i];
        return static_cast<double>(machine.sample_ns(1e7 * field.times[i]));
    });
    const auto samples = static_cast<double>(result.runners[*result.leader].times.size());
    tally.samples += samples;
    tally.cost_of_all += samples * std::accumulate(field.times.begin(), field.times.end(), 0.0);
    tally.good += field.times[*result.leader] <= as_good * field.times[0] ? 1 : 0;
    tally.best_dropped += result.runners[0].state != Runner::State::tied ? 1 : 0;
    for (const Runner& runner : result.runners) tally.ties += runner.state == Runner::State::tied ? 1 : 0;
}

void row(const Field& field, double noise, unsigned seed) {
    Tally tally;
    for (unsigned trial = 0; trial < trials; ++trial) add_trial(field, noise, seed + trial, tally);
    fmt::print("| {} | {:g} % | {:.1f} % | {:.1f} % | {:.0f} % | {:.0f} | {:.1f} |\n", field.name,
               100 * noise, 100.0 * tally.good / trials, 100.0 * tally.best_dropped / trials,
               100 * tally.cost / tally.cost_of_all, tally.samples / trials, 1.0 * tally.ties / trials);
}

}  // namespace

int main(int argc, char** argv) {
    const auto seed = argc > 1 ? static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10)) : 1u;
    fmt::print(
        "| candidates | noise | pick within 2 % of the best | best dropped | cost of trying all | samples | "
        "ties |\n");
    fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const Field& field : fields)
        for (const double noise : {0.01, 0.02, 0.05}) row(field, noise, seed);
}
