#include <algorithm>

#include <fmt/format.h>

#include "bench/measure/session_clock.h"
#include "bench/plan/tuned.h"
#include "bench/record/status.h"
#include "bench/report/axes.h"
#include "bench/report/sections.h"
#include "bench/report/words.h"

namespace ptb {
namespace {

constexpr std::size_t most_named = 3;

struct Group {
    Status status;
    std::string reason;
    std::vector<Case> cases;
};

std::vector<Group> groups(const ResultFile& result) {
    std::vector<Group> found;
    for (const Record& record : result.cases) {
        if (record.status == Status::ok || timed(record)) continue;
        auto group = std::find_if(found.begin(), found.end(), [&](const Group& g) {
            return g.status == record.status && g.reason == record.reason;
        });
        if (group == found.end()) group = found.insert(group, {record.status, record.reason, {}});
        group->cases.push_back(record.params);
    }
    return found;
}

/// "pocl:0 pt 128x128 SPP 10 work-group 64"
std::string name_of(const Case& c) {
    return fmt::format("{} {} {} SPP {} work-group {}{}", c.device, c.kernel, to_string(c.size), c.spp,
                       to_string(c.work_group), unusual_text(c));
}

std::string names_of(const std::vector<Case>& cases) {
    std::vector<std::string> names;
    for (const Case& c : cases)
        if (names.size() < most_named) names.push_back(name_of(c));
    const auto more = cases.size() - names.size();
    return fmt::format("{}{}", fmt::join(names, "; "), more == 0 ? "" : fmt::format("; and {} more", more));
}

/// What sets the clock differs: drivers and heat for a GPU's, the system or a virtual machine's host for a
/// CPU's.
std::string clock_note(const ResultFile& result, const LowClock& low) {
    const bool cpu = device_of(result, low.device).type == "CPU";
    return fmt::format(
        "{}: its clock stayed up to {:.0f} % below its best of this run in {} of {} cases, which are "
        "timed by that clock: {}",
        low.device, 100 * (1 - low.lowest_share), low.cases, low.of,
        cpu ? "`ptbench doctor` says what sets it; `ptbench ab` compares side by side"
            : "let it cool, or lock its clock (NVIDIA: `nvidia-smi -lgc`)");
}

}  // namespace

Section problems_section(const ResultFile& result) {
    Section section;
    section.title = "without a time";
    section.grid.columns = {{"status"}, {"cases", true}, {"reason"}, {"which"}};
    for (const Group& group : groups(result))
        section.grid.rows.push_back({to_string(group.status), std::to_string(group.cases.size()),
                                     group.reason, names_of(group.cases)});
    return section;
}

Section remarks_section(const ResultFile& result) {
    Section section;
    section.title = "remarks";
    if (result.run.interrupted)
        section.notes.push_back("interrupted: these are the cases measured until then");
    for (const auto& warning : result.warnings) section.notes.push_back("warning: " + warning);
    for (const LowClock& low : low_clocks(result.cases)) section.notes.push_back(clock_note(result, low));
    for (const Case& best : result.run.tuned)
        section.notes.push_back(fmt::format("tuned: {} on {} takes {} where the config leaves it open",
                                            best.kernel, best.device, launch_text(best)));
    for (const BrokenIcd& icd : result.broken_icds)
        section.notes.push_back(icd.icd + " is not usable: " + icd.reason);
    for (const DeviceInfo& device : result.devices)
        if (!device.excluded.empty())
            section.notes.push_back(device.key + " is not used: " + device.excluded);
    return section;
}

}  // namespace ptb
