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

/// Runs, those that the first ranking names first.
std::vector<std::size_t> in_order(std::size_t runs, const std::vector<Ranking>& rankings) {
    std::vector<std::size_t> order;
    if (!rankings.empty())
        for (const Standing& standing : rankings.front().standings)
            if (standing.run) order.push_back(*standing.run);
    for (std::size_t i = 0; i < runs; ++i) order.push_back(i);
    std::vector<std::size_t> once;
    for (const std::size_t i : order)
        if (std::find(once.begin(), once.end(), i) == once.end()) once.push_back(i);
    return once;
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

std::vector<RunGroup> run_groups(const std::vector<PageRun>& runs, const std::vector<Ranking>& rankings) {
    std::vector<RunGroup> groups;
    std::vector<std::string> keys;
    for (const std::size_t i : in_order(runs.size(), rankings)) {
        const std::string name = devices_text(runs[i].result);
        const std::string key = name + "\n" + drivers_text(runs[i].result);
        const auto known = std::find(keys.begin(), keys.end(), key);
        const auto place = static_cast<std::size_t>(known - keys.begin());
        if (known == keys.end()) {
            keys.push_back(key);
            groups.push_back({name, {}});
        }
        groups[place].runs.push_back(i);
    }
    for (RunGroup& group : groups) std::sort(group.runs.begin(), group.runs.end());
    return groups;
}

std::string run_id(std::size_t index) { return fmt::format("run-{}", index); }

}  // namespace ptb
