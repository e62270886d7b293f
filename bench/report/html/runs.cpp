#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "bench/report/html/html.h"
#include "bench/report/html/parts.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

/// The devices that cases were planned for.
std::string devices_text(const ResultFile& result) {
    std::vector<std::string> labels;
    std::set<std::string> seen;
    for (const Record& record : result.cases)
        if (seen.insert(record.params.device).second)
            labels.push_back(device_label(result, record.params.device));
    return fmt::format("{}", fmt::join(labels, ", "));
}

std::string drivers_text(const ResultFile& result) {
    std::vector<std::string> versions;
    for (const DeviceInfo& device : result.devices)
        if (device.excluded.empty() &&
            std::find(versions.begin(), versions.end(), device.driver_version) == versions.end())
            versions.push_back(device.driver_version);
    return fmt::format("{}", fmt::join(versions, ", "));
}

}  // namespace

std::string run_name(const std::vector<PageRun>& runs, std::size_t index) {
    const auto plain = [&](std::size_t i) {
        std::string date = runs[i].result.run.started_at.substr(0, 16);
        std::replace(date.begin(), date.end(), 'T', ' ');
        return fmt::format("{}{}{}, {}", runs[i].name, runs[i].name.empty() ? "" : ", ", date,
                           runs[i].result.host.hostname);
    };
    int same = 1;
    for (std::size_t i = 0; i < index; ++i) same += plain(i) == plain(index) ? 1 : 0;
    return same == 1 ? plain(index) : fmt::format("{} ({})", plain(index), same);
}

std::string runs_table(const std::vector<PageRun>& runs) {
    if (runs.size() < 2) return "";
    Grid grid;
    grid.columns = {{"run"},         {"devices"},           {"driver"}, {"config"},
                    {"cases", true}, {"with a time", true}, {"ptbench"}};
    TableExtras extras;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const ResultFile& r = runs[i].result;
        const auto times = std::count_if(r.cases.begin(), r.cases.end(), timed);
        grid.rows.push_back({run_name(runs, i), devices_text(r), drivers_text(r), r.run.config,
                             std::to_string(r.cases.size()), std::to_string(times), r.run.tool_version});
        extras.links.push_back(run_id(i));
    }
    return html_table(grid, fmt::format("{} runs", runs.size()), extras);
}

std::string run_id(std::size_t index) { return fmt::format("run-{}", index); }

}  // namespace ptb
