#include "bench/cli/value_checks.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "bench/plan/limits.h"

namespace ptb {

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
    const auto check = [=](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc() && end == text.data() + text.size();
        if (whole && value >= least && value <= most) return {};
        return fmt::format("found \"{}\"; allowed: an integer from {} to {}", text, least, most);
    };
    return {check, ""};
}

CLI::Validator not_empty(const std::string& allowed) {
    const auto check = [=](const std::string& text) -> std::string {
        return text.empty() ? fmt::format("found \"\"; allowed: {}", allowed) : "";
    };
    return {check, ""};
}

CLI::Validator seconds(bool zero_allowed) {
    const auto check = [=](const std::string& text) -> std::string {
        double value = std::nan("");
        const bool number = CLI::detail::lexical_cast(text, value) && value <= limits::most_seconds;
        if (number && (value > 0 || (zero_allowed && value == 0))) return {};
        return fmt::format("found \"{}\"; allowed: seconds, {}, at most 1e9", text,
                           zero_allowed ? "0 or more" : "more than 0");
    };
    return {check, ""};
}

}  // namespace ptb
