#include "bench/cli/tell.h"

#include <cstdlib>
#include <set>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/worker/progress.h"
#include "core/input/printable.h"

namespace ptb {

void put(std::FILE* out, const std::string& text) {
    std::fputs(text.c_str(), out);
    std::fflush(out);
}

void tell(const CommonFlags& flags, const std::string& line) {
    if (!flags.quiet && !line.empty()) put(stderr, line + "\n");
}

void tell_waiting(const CommonFlags& flags, const std::string& words) {
    const char* const clear_line = ::isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "";
    tell(flags, fmt::format("{}waiting for a worker of --launcher{}{}", clear_line, words.empty() ? "" : ": ",
                            words));
}

bool use_colour(const CommonFlags& flags, std::FILE* out) {
    if (flags.color != "auto") return flags.color == "always";
    const char* const no_colour = std::getenv("NO_COLOR");
    return (no_colour == nullptr || *no_colour == '\0') && ::isatty(::fileno(out)) != 0;
}

TextStyle text_style(const CommonFlags& flags, std::FILE* out) {
    return {::isatty(::fileno(out)) != 0 ? columns_of(out) : 0, use_colour(flags, out)};
}

void tell_what_is_left_out(const CommonFlags& flags, const DeviceList& list) {
    if (!flags.verbose) return;
    for (const DeviceInfo& device : list.devices) {
        if (!device.excluded.empty())
            tell(flags, fmt::format("not used: {}: {}", device.key, device.excluded));
    }
    for (const BrokenIcd& each : list.broken) {
        tell(flags, fmt::format("not usable: {}: {}", printable(each.icd), printable(each.reason)));
    }
}

void tell_build_logs(const CommonFlags& flags, const std::vector<Record>& records) {
    if (!flags.verbose) return;
    std::set<std::string> told;
    for (const Record& record : records) {
        if (!record.build || record.build->log.empty()) continue;
        const std::string title =
            fmt::format("build log of {} on {}", record.params.kernel, record.params.device);
        if (told.insert(title + record.build->log).second) tell(flags, title + ":\n" + record.build->log);
    }
}

}  // namespace ptb
