#include "bench/doctor/diagnosis.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/compare/gate_json.h"
#include "core/input/printable.h"

namespace ptb {

namespace {

/// All of the screen's blocks: fewer, of an interrupted run, say nothing of the noise.
bool complete(const SelfComparison& aa) { return aa.finding.n >= screen_blocks; }

Json aa_json(const SelfComparison& aa) {
    return {{"device", aa.device.key},
            {"params", encode(aa.gate.base)},
            {"not_measured", aa.gate.not_measured},
            {"timer", aa.gate.timer},
            {"timer_reason", aa.timer_reason},
            {"tick_ns", shown_tick_ns(aa.gate.screen)},
            {"finding", encode(aa.finding)},
            {"smallest_change", encode(smallest_change(aa, 0.05))},
            {"smallest_change_dedicated", encode(smallest_change(aa, 0.02))}};
}

Json remark_json(const Remark& remark) {
    return {{"weight", to_string(remark.weight)},
            {"about", remark.about},
            {"device", remark.device},
            {"seen", remark.seen},
            {"advice", remark.advice}};
}

std::string remark_text(const Remark& remark) {
    const std::string device = remark.device.empty() ? "" : fmt::format(" of {}", remark.device);
    const std::string line = fmt::format("{:<8} {}{}: {}\n", to_string(remark.weight), remark.about, device,
                                         printable(remark.seen));
    return remark.advice.empty() ? line : fmt::format("{}         -> {}\n", line, printable(remark.advice));
}

}  // namespace

void add_device_remarks(Diagnosis& diagnosis) {
    auto& remarks = diagnosis.remarks;
    for (const Remark& remark : driver_remarks(diagnosis.list)) remarks.push_back(remark);
    for (const SelfComparison& aa : diagnosis.devices) {
        remarks.push_back(timer_remark(aa));
        if (complete(aa) || !aa.gate.not_measured.empty()) remarks.push_back(self_remark(aa));
        if (complete(aa)) remarks.push_back(sight_remark(aa));
    }
}

std::string diagnosis_text(const Diagnosis& diagnosis) {
    auto remarks = diagnosis.remarks;
    std::stable_sort(remarks.begin(), remarks.end(),
                     [](const Remark& a, const Remark& b) { return a.weight > b.weight; });
    std::string text;
    for (const Remark& remark : remarks) text += remark_text(remark);
    return text;
}

std::string diagnosis_json(const Diagnosis& diagnosis) {
    Json json{{"schema", "ptbench.doctor.v1"},
              {"host", encode(diagnosis.host)},
              {"devices", encode(diagnosis.list.devices)},
              {"broken_icds", encode(diagnosis.list.broken)},
              {"remarks", Json::array()},
              {"aa", Json::array()}};
    for (const Remark& remark : diagnosis.remarks) json["remarks"].push_back(remark_json(remark));
    for (const SelfComparison& aa : diagnosis.devices)
        if (complete(aa) || !aa.gate.not_measured.empty()) json["aa"].push_back(aa_json(aa));
    return dump_json(json, 2) + "\n";
}

}  // namespace ptb
