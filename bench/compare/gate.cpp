#include "bench/compare/gate.h"

#include <algorithm>
#include <cmath>

#include "bench/compare/evidence.h"
#include "bench/compare/rank_tests.h"
#include "bench/measure/statistics.h"

namespace ptb {
namespace {

double shortest(const Round& round, const std::string& timer) {
    const auto& times = timer == "host" ? round.host_ns : round.kernel_ns;
    return static_cast<double>(*std::min_element(times.begin(), times.end()));
}

double median_round(std::span<const Block> blocks, const std::string& timer, std::size_t first,
                    std::size_t second) {
    std::vector<double> times;
    for (const Block& block : blocks)
        for (const std::size_t i : {first, second}) times.push_back(shortest(block.rounds[i], timer));
    std::sort(times.begin(), times.end());
    return quantile(times, 0.5);
}

Evidence evidence_of(std::span<const double> d) {
    Evidence evidence;
    evidence.shift = centre(d, interval_confidence);
    evidence.p = evidence.holm_p = signed_rank_p(d);
    evidence.standard_error = moments(d).sd / std::sqrt(static_cast<double>(d.size()));
    return evidence;
}

/// With fewer than all fresh blocks, when to stop would have been somebody's choice.
bool confirmed(const GateCase& c) { return static_cast<int>(c.confirm.size()) >= confirm_blocks; }

/// Everything but the state.
Finding described(const GateCase& c) {
    Finding finding;
    const auto& blocks = confirmed(c) ? c.confirm : c.screen;
    finding.n = static_cast<int>(blocks.size());
    finding.evidence = evidence_of(differences(blocks, c.timer));
    finding.base_ns = median_round(blocks, c.timer, 0, 3);
    finding.now_ns = median_round(blocks, c.timer, 1, 2);
    finding.smallest_effect = smallest_effect(c.tolerance, finding.evidence.standard_error);
    return finding;
}

/// Holm over the cases that fresh blocks were taken of: only they can be called changed.
void correct(std::span<const GateCase> cases, std::vector<Finding>& findings) {
    std::vector<double> p;
    for (std::size_t i = 0; i < cases.size(); ++i)
        if (confirmed(cases[i])) p.push_back(findings[i].evidence.p);
    const auto corrected = holm(p);
    std::size_t next = 0;
    for (std::size_t i = 0; i < cases.size(); ++i)
        if (confirmed(cases[i])) findings[i].evidence.holm_p = corrected[next++];
}

State state_of(const GateCase& c, const Finding& finding) {
    if (c.screen.empty()) return c.without_times;
    if (static_cast<int>(c.screen.size()) < screen_blocks) return State::inconclusive;
    const State state = judge(finding.evidence, c.tolerance);
    const bool changed = state == State::regressed || state == State::improved;
    return changed && !confirmed(c) ? State::inconclusive : state;
}

}  // namespace

std::vector<double> differences(std::span<const Block> blocks, const std::string& timer) {
    std::vector<double> d;
    for (const Block& block : blocks) {
        const auto log_ns = [&](std::size_t i) { return std::log(shortest(block.rounds[i], timer)); };
        d.push_back((log_ns(1) + log_ns(2) - log_ns(0) - log_ns(3)) / 2);
    }
    return d;
}

bool suspect(const GateCase& c) {
    if (c.screen.empty()) return false;
    const auto d = differences(c.screen, c.timer);
    return signed_rank_p(d) < suspect_p &&
           std::abs(centre(d, interval_confidence).value) > std::log1p(c.tolerance) / 2;
}

std::vector<Finding> decide(std::span<const GateCase> cases) {
    std::vector<Finding> findings;
    for (const GateCase& c : cases) findings.push_back(c.screen.empty() ? Finding() : described(c));
    correct(cases, findings);
    for (std::size_t i = 0; i < cases.size(); ++i) findings[i].state = state_of(cases[i], findings[i]);
    return findings;
}

}  // namespace ptb
