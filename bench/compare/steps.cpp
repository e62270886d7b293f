#include "bench/compare/steps.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <random>

#include "bench/compare/evidence.h"
#include "bench/compare/rank_tests.h"
#include "bench/compare/sessions.h"
#include "bench/compare/verdict.h"
#include "bench/measure/statistics.h"

namespace ptb {
namespace {

using Values = std::span<const double>;

/// What p are multiplied with, since three questions are asked: Bonferroni's method, most weight on steps.
constexpr double for_steps = 2, for_excursions = 4, for_newest = 4;
constexpr int most_orders = 50'000, enough_as_far = 20;

/// Values [from, to) of a series, and what makes rank sums of different lengths comparable.
struct Stretch {
    std::size_t from = 0, to = 0;
    double weight = 0;
};

Stretch stretch(std::size_t from, std::size_t to, std::size_t n) {
    const auto inside = static_cast<double>(to - from), all = static_cast<double>(n);
    return {from, to, all / (inside * (all - inside))};
}

std::vector<Stretch> beginnings(std::size_t n) {
    std::vector<Stretch> all;
    for (std::size_t to = fewest_of_level; to + fewest_of_level <= n; ++to) all.push_back(stretch(0, to, n));
    return all;
}

std::vector<Stretch> excursions(std::size_t n) {
    std::vector<Stretch> all;
    for (std::size_t from = fewest_of_level; from < n; ++from)
        for (std::size_t to = from + fewest_of_level; to + fewest_of_level <= n; ++to)
            all.push_back(stretch(from, to, n));
    return all;
}

struct Found {
    Stretch where;
    double distance = 0;  ///< squared, in units of the values' standard deviation
    double p = 1;
};

/// Values about their mean, those over twice the least shift off the median counting as just that far off: a
/// run that was disturbed weighs no more than one of another level.
std::vector<double> clipped(Values values, double least_shift) {
    std::vector<double> sorted(values.begin(), values.end()), result(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double middle = values.empty() ? 0 : quantile(sorted, 0.5), most = 2 * least_shift;
    for (double& value : result) value = std::clamp(value - middle, -most, most);
    const double mean = moments(result).mean;
    for (double& value : result) value -= mean;
    return result;
}

/// The stretch whose mean is farthest from that of the rest.
Found farthest(const std::vector<double>& about_mean, const std::vector<Stretch>& stretches) {
    std::vector<double> sums{0};
    for (const double value : about_mean) sums.push_back(sums.back() + value);
    Found found;
    for (const Stretch& s : stretches) {
        const double sum = sums[s.to] - sums[s.from], distance = sum * sum * s.weight;
        if (distance > found.distance) found = {s, distance, 1};
    }
    return found;
}

/// The share of random orders that have a stretch as far off. Ends when enough have: see "Sequential Monte
/// Carlo p-values", by J. Besag and P. Clifford.
double order_p(std::vector<double> values, const std::vector<Stretch>& stretches, double distance) {
    constexpr double rounding = 1e-9;
    std::mt19937 random(1);
    int orders = 0, as_far = 0;
    while (orders < most_orders && as_far < enough_as_far) {
        std::shuffle(values.begin(), values.end(), random);
        ++orders;
        if (farthest(values, stretches).distance >= distance * (1 - rounding)) ++as_far;
    }
    return as_far == enough_as_far ? 1.0 * as_far / orders : (as_far + 1.0) / (orders + 1.0);
}

struct Parts {
    std::vector<double> inside, outside;
};

Parts parts(Values values, const Stretch& s) {
    Parts both;
    for (std::size_t i = 0; i < values.size(); ++i)
        (i >= s.from && i < s.to ? both.inside : both.outside).push_back(values[i]);
    return both;
}

/// By random orders, which see through disturbed runs; what is rarer than they can show has the bound by the
/// Mann-Whitney test, once for each stretch.
std::optional<Found> searched(Values values, const std::vector<Stretch>& stretches, double least_shift) {
    const auto about_mean = clipped(values, least_shift);
    Found found = farthest(about_mean, stretches);
    if (!(found.distance > 0)) return std::nullopt;
    const Parts both = parts(values, found.where);
    const double bound = rank_sum_p(both.outside, both.inside) * static_cast<double>(stretches.size());
    found.p = bound * most_orders < 1 ? bound : order_p(about_mean, stretches, found.distance);
    return found;
}

/// The surest step and the surest excursion.
std::vector<Found> candidates(Values values, double least_shift) {
    std::vector<Found> all;
    const auto add = [&](const std::vector<Stretch>& stretches, double correction) {
        auto found = searched(values, stretches, least_shift);
        if (!found) return;
        found->p = std::min(1.0, found->p * correction);
        all.push_back(*found);
    };
    add(beginnings(values.size()), for_steps);
    add(excursions(values.size()), for_excursions);
    return all;
}

/// The surest change that is to be told, if there is one.
std::optional<Found> change_in(Values values, const StepRules& rules) {
    std::optional<Found> surest;
    for (Found found : candidates(values, rules.least_shift)) {
        found.p = std::min(1.0, found.p * rules.correction);
        const Parts both = parts(values, found.where);
        const double shift = shift_between(both.outside, both.inside, interval_confidence).value;
        const bool told = found.p < step_p && std::abs(shift) >= rules.least_shift;
        if (told && (!surest || found.p < surest->p)) surest = found;
    }
    return surest;
}

/// Beginnings of levels, and how sure each is.
using Marks = std::map<std::size_t, double>;

void search(Values values, std::size_t from, std::size_t to, const StepRules& rules, Marks& marks) {
    const auto found = change_in(values.subspan(from, to - from), rules);
    if (!found) return;
    std::vector<std::size_t> ends{from, from + found->where.from, from + found->where.to, to};
    for (const std::size_t end : {ends[1], ends[2]})
        if (end > from && end < to) marks[end] = found->p;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) search(values, ends[i], ends[i + 1], rules, marks);
}

/// Each mark where the levels before and after it are told apart best, now that those are known.
Marks placed(Values values, const Marks& marks, double least_shift) {
    Marks result;
    std::size_t from = 0;
    for (auto mark = marks.begin(); mark != marks.end(); ++mark) {
        const std::size_t to = std::next(mark) == marks.end() ? values.size() : std::next(mark)->first;
        const auto piece = values.subspan(from, to - from);
        const auto stretches = beginnings(piece.size());
        const Found best = farthest(clipped(piece, least_shift), stretches);
        const std::size_t at = best.distance > 0 ? from + best.where.to : mark->first;
        result[at] = mark->second;
        from = at;
    }
    return result;
}

Shift shift_at(Values values, std::size_t from, std::size_t at, std::size_t to) {
    return shift_between(values.subspan(from, at - from), values.subspan(at, to - at), interval_confidence);
}

std::vector<Step> steps_at(Values values, const Marks& marks) {
    std::vector<Step> all;
    std::size_t from = 0;
    for (auto mark = marks.begin(); mark != marks.end(); ++mark) {
        const std::size_t to = std::next(mark) == marks.end() ? values.size() : std::next(mark)->first;
        all.push_back({mark->first, shift_at(values, from, mark->first, to), mark->second, false});
        from = mark->first;
    }
    return all;
}

/// Without changes that turn out to be too small between the levels beside them, the smallest first.
std::vector<Step> large_steps(Values values, Marks marks, double least_shift) {
    const auto smaller = [](const Step& a, const Step& b) {
        return std::abs(a.shift.value) < std::abs(b.shift.value);
    };
    for (;;) {
        const auto all = steps_at(values, marks);
        const auto smallest = std::min_element(all.begin(), all.end(), smaller);
        if (all.empty() || std::abs(smallest->shift.value) >= least_shift) return all;
        marks.erase(smallest->at);
    }
}

/// Whether the last few of the values lie off the others, for each number of them.
std::vector<Step> newest_steps(Values values) {
    std::vector<Step> all;
    constexpr double tried = fewest_of_level - 1;
    for (std::size_t few = 2; few <= fewest_of_level; ++few) {
        if (values.size() < few + enough_sessions) continue;
        const std::size_t at = values.size() - few;
        const auto told = predict(values.first(at), values.subspan(at), interval_confidence);
        const double p = std::min(1.0, told->p * tried * for_newest);
        all.push_back({at, {told->difference, Interval{told->low, told->high}}, p, true});
    }
    return all;
}

/// Whether all values from a place on lie off the mean of those before it, to one side: one far off is none.
bool all_off(Values values, std::size_t at, double least_shift) {
    const double mean = moments(values.first(at)).mean;
    const auto rest = values.subspan(at);
    const auto above = [&](double value) { return value - mean >= least_shift; };
    const auto below = [&](double value) { return mean - value >= least_shift; };
    return std::all_of(rest.begin(), rest.end(), above) || std::all_of(rest.begin(), rest.end(), below);
}

/// The surest of them that is to be told, if there is one.
std::optional<Step> newest_step(Values values, const StepRules& rules) {
    std::optional<Step> surest;
    for (Step step : newest_steps(values)) {
        step.p = std::min(1.0, step.p * rules.correction);
        const bool told = step.p < step_p && all_off(values, step.at, rules.least_shift);
        if (told && (!surest || step.p < surest->p)) surest = step;
    }
    return surest;
}

}  // namespace

std::vector<Step> steps(std::span<const double> logs, const StepRules& rules) {
    Marks marks;
    search(logs, 0, logs.size(), rules, marks);
    std::vector<Step> all = large_steps(logs, placed(logs, marks, rules.least_shift), rules.least_shift);
    const std::size_t last = all.empty() ? 0 : all.back().at;
    if (auto newest = newest_step(logs.subspan(last), rules)) {
        newest->at += last;
        all.push_back(*newest);
    }
    return all;
}

double surest_p(std::span<const double> logs, double least_shift) {
    double p = 1;
    for (const Found& found : candidates(logs, least_shift)) p = std::min(p, found.p);
    for (const Step& step : newest_steps(logs)) p = std::min(p, step.p);
    return p;
}

}  // namespace ptb
