// The decision of `ptbench ab` on simulated timings of 20 cases, beside a test against a stored baseline.
#include "bench/compare/gate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "bench/compare/rank_tests.h"
#include "bench/measure/statistics.h"
#include "scripts/experiments/machine.h"

namespace {

using namespace ptb;

constexpr int cases_per_gate = 20;
constexpr int stored_samples = 25;  // of a case, a side, where a baseline is stored

struct Code {
    double base_ns = 1e7, now_ns = 1e7;
};

Round round_of(Machine& machine, double true_ns) {
    Round round;
    for (int i = 0; i < round_samples; ++i) round.kernel_ns.push_back(machine.sample_ns(true_ns));
    return round;
}

void add_block(Machine& machine, const Code& code, std::vector<Block>& blocks) {
    Block block;
    for (const double ns : {code.base_ns, code.now_ns, code.now_ns, code.base_ns})
        block.rounds.push_back(round_of(machine, ns));
    blocks.push_back(block);
}

/// The states of a gate as `ptbench ab` runs it: all cases screened, block by block, then suspects confirmed.
std::vector<State> ab_gate(Machine machine, const std::vector<Code>& codes, double tolerance) {
    std::vector<GateCase> cases(codes.size());
    for (auto& c : cases) {
        c.timer = "event";
        c.tolerance = tolerance;
    }
    for (int block = 0; block < screen_blocks; ++block)
        for (std::size_t i = 0; i < cases.size(); ++i) add_block(machine, codes[i], cases[i].screen);
    const std::vector<GateCase> screened = cases;
    for (int block = 0; block < confirm_blocks; ++block)
        for (std::size_t i = 0; i < cases.size(); ++i)
            if (suspect(screened[i])) add_block(machine, codes[i], cases[i].confirm);
    std::vector<State> states;
    for (const Finding& finding : decide(cases)) states.push_back(finding.state);
    return states;
}

/// The same machine measures the base first, whole, and the new version afterwards; a case is called changed
/// when the Mann-Whitney test of its samples says so (p < 0.05) and the medians differ by `tolerance`.
std::vector<State> stored_baseline(Machine machine, const std::vector<Code>& codes, double tolerance) {
    std::vector<std::vector<double>> times[2];
    for (const bool now : {false, true}) {
        for (const Code& code : codes) {
            auto& of_case = times[now].emplace_back();
            for (int n = 0; n < stored_samples; ++n)
                of_case.push_back(static_cast<double>(machine.sample_ns(now ? code.now_ns : code.base_ns)));
        }
    }
    std::vector<State> states;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        auto &base = times[0][i], &now = times[1][i];
        const double p = rank_sum_p(base, now);
        std::sort(base.begin(), base.end());
        std::sort(now.begin(), now.end());
        const double ratio = quantile(now, 0.5) / quantile(base, 0.5);
        const bool changed = p < 0.05 && std::abs(std::log(ratio)) > std::log1p(tolerance);
        states.push_back(!changed ? State::same : ratio > 1 ? State::regressed : State::improved);
    }
    return states;
}

/// What happened over many gates; in `codes` the first case may be slower.
struct Tally {
    int gates = 0, alarmed_gates = 0, alarms = 0, found = 0, changed_others = 0;
};

/// A method, and about how many samples it takes of all cases.
struct Gate {
    const char* name;
    std::vector<State> (*decide)(Machine, const std::vector<Code>&, double tolerance);
    int samples;
};
constexpr Gate paired{"ab", ab_gate, cases_per_gate* screen_blocks * 4 * round_samples};
constexpr Gate stored{"stored baseline", stored_baseline, cases_per_gate * 2 * stored_samples};

Tally tally(const Gate& gate, int gates, double noise, double slowdown, double tolerance, unsigned seed) {
    std::vector<Code> codes(cases_per_gate);
    codes[0].now_ns *= 1 + slowdown;
    Tally sum;
    for (sum.gates = 0; sum.gates < gates; ++sum.gates) {
        const auto states = gate.decide(Machine(noise, gate.samples, seed + static_cast<unsigned>(sum.gates)),
                                        codes, tolerance);
        int alarms = 0;
        for (std::size_t i = 0; i < states.size(); ++i) {
            alarms += states[i] == State::regressed ? 1 : 0;
            const bool changed = states[i] == State::regressed || states[i] == State::improved;
            if (i > 0) sum.changed_others += changed ? 1 : 0;
        }
        sum.alarms += alarms;
        sum.alarmed_gates += alarms > 0 ? 1 : 0;
        sum.found += states[0] == State::regressed ? 1 : 0;
    }
    return sum;
}

void row(const Gate& gate, int gates, double noise, double slowdown, double tolerance, unsigned seed) {
    const Tally t = tally(gate, gates, noise, slowdown, tolerance, seed);
    const std::string truth =
        slowdown > 0 ? fmt::format("1 of 20 is {:g} % slower", 100 * slowdown) : "identical";
    const std::string found = slowdown > 0 ? fmt::format("{} of {}", t.found, gates) : "-";
    fmt::print("| {} | {} | {:g} % | {:g} % | {} of {} | {} | {:.2f} % |\n", truth, gate.name, 100 * noise,
               100 * tolerance, t.alarmed_gates, gates, found,
               100.0 * t.changed_others / (gates * (cases_per_gate - 1)));
}

}  // namespace

int main(int argc, char** argv) {
    const auto seed = argc > 1 ? static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10)) : 1u;
    fmt::print(
        "| truth | method | noise | tolerance | gates with an alarm | found | other cases called changed "
        "|\n");
    fmt::print("| --- | --- | ---: | ---: | ---: | ---: | ---: |\n");
    for (const double noise : {0.01, 0.02, 0.05}) row(paired, 200, noise, 0, 0.03, seed);
    for (const double noise : {0.01, 0.02, 0.05}) row(stored, 200, noise, 0, 0.02, seed);
    row(paired, 100, 0.01, 0.05, 0.03, seed);
    row(stored, 100, 0.01, 0.05, 0.03, seed);
    row(stored, 100, 0.01, 0.05, 0.02, seed);
}
