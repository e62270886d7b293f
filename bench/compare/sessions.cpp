#include "bench/compare/sessions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bench/compare/differences.h"
#include "bench/compare/evidence.h"
#include "bench/compare/match.h"
#include "bench/compare/rank_tests.h"
#include "bench/measure/statistics.h"

namespace ptb {
namespace {

/// What differs between two sessions' case, into the comparison.
void add_differing(const SessionCase& one, const SessionCase& other, Comparison& comparison) {
    for (const Difference& each : differences(one, other))
        (each.may_differ ? comparison.notes : comparison.differing).insert(each.text);
}

void add_differing(const Matched& m, Comparison& comparison) {
    if (m.base.empty() || m.now.empty()) return;
    for (const auto* const side : {&m.base, &m.now})
        for (const SessionCase* const c : *side) add_differing(*m.base.front(), *c, comparison);
}

/// Of very many values, evenly spaced order statistics: pairs of all would not fit into memory.
std::vector<double> thinned(std::vector<double> values) {
    constexpr std::size_t most = 1000;
    if (values.size() <= most) return values;
    std::sort(values.begin(), values.end());
    std::vector<double> kept;
    for (std::size_t i = 0; i < most; ++i)
        kept.push_back(quantile(values, (static_cast<double>(i) + 0.5) / most));
    return kept;
}

std::vector<double> logs(const std::vector<const SessionCase*>& cases, bool samples) {
    std::vector<double> values;
    for (const SessionCase* const c : cases) {
        const auto times = samples ? c->times_ns : std::vector{c->median_ns()};
        for (const double ns : times) values.push_back(std::log(ns));
    }
    return thinned(std::move(values));
}

double median_of_logs(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return std::exp(quantile(values, 0.5));
}

/// The standard error of the difference of two means; unknown where a side has a single value.
double error_between(const std::vector<double>& base, const std::vector<double>& now) {
    if (base.size() < 2 || now.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    const double b = moments(base).sd, n = moments(now).sd;
    return std::sqrt(b * b / static_cast<double>(base.size()) + n * n / static_cast<double>(now.size()));
}

/// Of several sessions, the median; nothing where none says it.
std::optional<double> efficiency_of(const std::vector<const SessionCase*>& cases) {
    std::vector<double> values;
    for (const SessionCase* const c : cases)
        if (c->efficiency && *c->efficiency > 0) values.push_back(std::log(*c->efficiency));
    return values.empty() ? std::nullopt : std::optional(median_of_logs(values));
}

std::optional<double> efficiency_ratio(const Matched& m) {
    const auto base = efficiency_of(m.base), now = efficiency_of(m.now);
    return base && now ? std::optional(*now / *base) : std::nullopt;
}

Finding finding_between(const std::vector<double>& base, const std::vector<double>& now) {
    Finding finding;
    finding.base_ns = median_of_logs(base);
    finding.now_ns = median_of_logs(now);
    finding.evidence.shift = shift_between(base, now, interval_confidence);
    finding.evidence.p = rank_sum_p(base, now);
    finding.evidence.standard_error = error_between(base, now);
    finding.n = static_cast<int>(std::min(base.size(), now.size()));
    return finding;
}

Finding finding_after(const std::vector<double>& history, double now) {
    Finding finding;
    finding.base_ns = median_of_logs(history);
    finding.now_ns = std::exp(now);
    finding.n = static_cast<int>(history.size());
    const auto predicted = predict(history, std::array{now}, interval_confidence);
    finding.evidence.standard_error = std::numeric_limits<double>::quiet_NaN();
    finding.evidence.shift.value = now - moments(history).mean;
    if (!predicted) return finding;
    finding.evidence.shift.interval = Interval{predicted->low, predicted->high};
    finding.evidence.p = predicted->p;
    finding.evidence.standard_error = predicted->standard_error;
    return finding;
}

std::string advice(const Matched& m, bool single, const CompareRules& rules) {
    const auto low_n = [](const SessionCase* c) { return c->low_n; };
    if (std::any_of(m.base.begin(), m.base.end(), low_n) || std::any_of(m.now.begin(), m.now.end(), low_n))
        return "low_n";
    if (single) return rules.gate_single_session ? "" : "single-session";
    if (m.base.size() >= enough_sessions && m.now.size() >= enough_sessions) return "";
    return fmt::format("{} and {} sessions, {} a side gate", m.base.size(), m.now.size(), enough_sessions);
}

/// Fills in what was found of a case with times on both sides, and why it may not gate.
using Describe = std::function<void(const Matched&, Row&)>;

/// A row but for what needs all rows.
Row row_of(const Matched& m, const CompareRules& rules, const Describe& describe) {
    Row row;
    row.device = m.like->device;
    row.name = m.like->name;
    row.tolerance = rules.tolerance(*m.like);
    if (!m.base.empty() && !m.now.empty()) {
        describe(m, row);
        if (m.now.front()->device != row.device) row.note = "new: device " + m.now.front()->device;
        row.efficiency_ratio = efficiency_ratio(m);
        return row;
    }
    row.finding.state = m.base.empty() ? State::unmeasured : State::missing;
    row.note = m.now.empty() ? m.why_not : "the base has no time";
    return row;
}

void judge_all(std::vector<Row>& rows) {
    std::vector<double> p;
    for (const Row& row : rows)
        if (row.compared()) p.push_back(row.finding.evidence.p);
    const auto corrected = holm(p);
    std::size_t next = 0;
    for (Row& row : rows) {
        if (!row.compared()) continue;
        Evidence& evidence = row.finding.evidence;
        evidence.holm_p = corrected[next++];
        row.finding.state = judge(evidence, row.tolerance);
        row.finding.smallest_effect = smallest_effect(row.tolerance, evidence.standard_error);
    }
}

/// Rows by `describe`, judged; none where fingerprints differ and may not.
Comparison compared(const std::vector<Session>& base, const std::vector<Session>& now,
                    const CompareRules& rules, const Describe& describe) {
    Comparison comparison;
    for (const Matched& m : match(base, now, rules.allow_cross)) {
        add_differing(m, comparison);
        comparison.rows.push_back(row_of(m, rules, describe));
    }
    if (!comparison.differing.empty() && !rules.allow_cross) comparison.rows.clear();
    judge_all(comparison.rows);
    if (rules.allow_cross)
        for (Row& row : comparison.rows)
            row.advisory = comparison.differing.empty() ? "--allow-cross" : "not comparable";
    return comparison;
}

}  // namespace

Comparison compare_sessions(const std::vector<Session>& base, const std::vector<Session>& now,
                            const CompareRules& rules) {
    const bool single = base.size() == 1 && now.size() == 1;
    return compared(base, now, rules, [&](const Matched& m, Row& row) {
        row.finding = finding_between(logs(m.base, single), logs(m.now, single));
        row.advisory = advice(m, single, rules);
    });
}

Comparison compare_history(std::vector<Session> history, const Session& now, const CompareRules& rules) {
    std::stable_sort(history.begin(), history.end(),
                     [](const Session& a, const Session& b) { return a.started_at < b.started_at; });
    if (history.size() > most_history)
        history.erase(history.begin(), history.end() - static_cast<std::ptrdiff_t>(most_history));
    return compared(history, {now}, rules, [](const Matched& m, Row& row) {
        row.finding = finding_after(logs(m.base, false), std::log(m.now.front()->median_ns()));
        if (m.now.front()->low_n) row.advisory = "low_n";
        if (m.base.size() < enough_sessions)
            row.advisory = fmt::format("{} earlier sessions, {} gate", m.base.size(), enough_sessions);
    });
}

}  // namespace ptb
