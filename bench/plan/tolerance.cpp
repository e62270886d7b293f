#include "bench/plan/tolerance.h"

#include <charconv>

#include <fmt/format.h>

#include "bench/plan/tuned.h"
#include "core/input/printable.h"

namespace ptb {

double parse_percent(std::string_view text) {
    std::string_view number = text.ends_with('%') ? text.substr(0, text.size() - 1) : std::string_view();
    while (number.ends_with(' ')) number.remove_suffix(1);
    double percent = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), percent);
    const bool whole = error == std::errc() && end == number.data() + number.size();
    if (!whole || !(percent > 0 && percent <= 100))
        throw UsageError(fmt::format("found {}; allowed: a percentage above 0 and at most 100, as 5%",
                                     shortened(printable(text), 40)));
    return percent / 100;
}

std::string percent_text(double share) { return fmt::format("{:.6g}%", 100 * share); }

Tolerances::Tolerances(const Config& config, std::optional<double> flag, double otherwise)
    : otherwise_(flag ? *flag : config.tolerance.value_or(otherwise)) {
    if (flag) return;
    for (const Series& series : config.series) {
        Config alone;
        alone.series = {series};
        for (const Case& c : expand(alone, {DeviceInfo()}))
            of_case_.try_emplace(c, series.tolerance.value_or(otherwise_));
    }
}

double Tolerances::of(Case c) const {
    c = as_asked(c);
    c.device.clear();
    const auto found = of_case_.find(c);
    return found == of_case_.end() ? otherwise_ : found->second;
}

}  // namespace ptb
