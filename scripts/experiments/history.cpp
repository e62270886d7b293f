// What `ptbench report --history` marks in simulated histories, with the code that marks it.
#include "bench/compare/history.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "scripts/experiments/machine.h"

namespace {

using namespace ptb;

constexpr int runs = 30, samples = 25;
constexpr double usual_ns = 1e7, step = 1.05, tolerance = 0.05;

/// What has the noise: each sample, on a machine that drifts in a run and has neighbours, or a run as a
/// whole.
enum class Noisy { of_samples, of_runs };

/// Whether the true time of a run is the higher one.
using Slow = bool (*)(int run, int at);
bool never(int, int) { return false; }
bool from_then_on(int run, int at) { return run >= at; }

Session session(int run, std::vector<double> times_ns) {
    SessionCase c;
    c.device = "gpu:0";
    c.name = std::string("pt");
    c.times_ns = std::move(times_ns);
    return {fmt::format("{}.json", run), fmt::format("{:04}", run), {c}};
}

/// A history whose time changes at a run, as sessions.
std::vector<Session> history(Noisy kind, double noise, Slow slow, int at, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<> normal(0, noise);
    std::vector<Session> all;
    for (int run = 0; run < runs; ++run) {
        const double true_ns = usual_ns * (slow(run, at) ? step : 1);
        const double of_run = kind == Noisy::of_runs ? std::exp(normal(random)) : 1;
        Machine machine(noise, samples, static_cast<unsigned>(random()));
        std::vector<double> times;
        for (int i = 0; i < samples; ++i)
            times.push_back(kind == Noisy::of_runs ? true_ns * of_run
                                                   : static_cast<double>(machine.sample_ns(true_ns)));
        all.push_back(session(run, times));
    }
    return all;
}

std::vector<Step> marks(const std::vector<Session>& sessions) {
    const auto five_percent = [](const SessionCase&) { return tolerance; };
    return history_of(sessions, five_percent).lines.at(0).steps;
}

bool marked(const std::vector<Step>& found, int at, int within) {
    return std::any_of(found.begin(), found.end(), [&](const Step& each) {
        return each.shift.value > 0 && std::abs(static_cast<int>(each.at) - at) <= within;
    });
}

/// How many runs with the new time it takes until the change is marked, at most two runs off.
std::optional<int> delay(const std::vector<Session>& sessions, int at) {
    for (int seen = at + 1; seen <= runs; ++seen)
        if (marked(marks({sessions.begin(), sessions.begin() + seen}), at, 2)) return seen - at;
    return std::nullopt;
}

const char* text(Noisy kind) { return kind == Noisy::of_samples ? "of samples" : "of runs"; }

void flat_row(Noisy kind, double noise, int histories, unsigned seed) {
    int alarmed = 0;
    for (int i = 0; i < histories; ++i)
        alarmed += marks(history(kind, noise, never, 0, seed + static_cast<unsigned>(i))).empty() ? 0 : 1;
    fmt::print("| none | {} | {:g} % | {} of {} | - | - |\n", text(kind), 100 * noise, alarmed, histories);
}

/// Changes at any run that has eight others on both sides.
void step_row(Noisy kind, double noise, int histories, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<> place(8, runs - 8);
    int found = 0, others = 0;
    std::vector<int> delays;
    for (int i = 0; i < histories; ++i) {
        const int at = place(random);
        const auto sessions = history(kind, noise, from_then_on, at, seed + static_cast<unsigned>(i));
        const auto told = marks(sessions);
        found += marked(told, at, 2) ? 1 : 0;
        others += told.size() > (marked(told, at, 2) ? 1u : 0u) ? 1 : 0;
        delays.push_back(delay(sessions, at).value_or(runs));
    }
    std::sort(delays.begin(), delays.end());
    fmt::print("| 5 % slower | {} | {:g} % | {} of {} | {} of {} | {} |\n", text(kind), 100 * noise, others,
               histories, found, histories, delays[delays.size() / 2]);
}

}  // namespace

int main(int argc, char** argv) {
    const auto seed = argc > 1 ? static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10)) : 1u;
    const auto noises = {0.01, 0.02, 0.03};
    fmt::print(
        "| change | noise | | with a wrong mark | marked, at most two runs off | runs until then, median "
        "|\n");
    fmt::print("| --- | --- | ---: | ---: | ---: | ---: |\n");
    for (const Noisy kind : {Noisy::of_samples, Noisy::of_runs}) {
        for (const double noise : noises) flat_row(kind, noise, 200, seed);
        for (const double noise : noises) step_row(kind, noise, 200, seed);
    }
}
