#include "bench/compare/verdict.h"

#include <cmath>
#include <utility>

namespace ptb {
namespace {

constexpr std::pair<State, const char*> words[] = {
    {State::regressed, "regressed"},       {State::improved, "improved"}, {State::same, "same"},
    {State::inconclusive, "inconclusive"}, {State::missing, "missing"},   {State::unmeasured, "unmeasured"}};

}  // namespace

std::string to_string(State state) {
    for (const auto& [value, word] : words)
        if (value == state) return word;
    return "unknown";
}

std::optional<State> parse_state(std::string_view text) {
    for (const auto& [value, word] : words)
        if (text == word) return value;
    return std::nullopt;
}

double Evidence::ratio() const { return std::exp(shift.value); }

State judge(const Evidence& evidence, double tolerance) {
    const double allowed = std::log1p(tolerance);
    const bool significant = evidence.holm_p < significant_p;
    if (significant && evidence.shift.value >= allowed) return State::regressed;
    if (significant && evidence.shift.value <= -allowed) return State::improved;
    const auto& interval = evidence.shift.interval;
    const bool inside = interval && interval->low >= -allowed && interval->high <= allowed;
    return inside ? State::same : State::inconclusive;
}

}  // namespace ptb
