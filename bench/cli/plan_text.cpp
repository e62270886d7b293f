#include "bench/cli/plan_text.h"

#include <fmt/format.h>

#include "core/input/printable.h"

namespace ptb {

std::string plan_text(const std::vector<Case>& cases, const Forecast& forecast) {
    std::string text;
    for (const Case& c : cases) {
        std::string line = fmt::format("{}  {}  {}  {}  spp {}  path length {}  work-group {}  lanes {}",
                                       c.device, c.kernel, printable(c.scene), to_string(c.size), c.spp,
                                       c.path_length, to_string(c.work_group), case_value(c, "lanes"));
        for (const std::string& more : {to_string(c.variant), of_several_devices(c)})
            if (!more.empty()) line += "  " + more;
        const auto predicted_s = forecast.case_s(c);
        if (predicted_s) line += fmt::format("  ~ {}", duration_text(*predicted_s));
        text += line + "\n";
    }
    return text;
}

}  // namespace ptb
