#include "bench/fleet/plan.h"

#include <stdexcept>

#include <fmt/format.h>

#include "bench/plan/data_dir.h"
#include "bench/record/continued.h"
#include "bench/record/journal.h"
#include "bench/record/json.h"
#include "bench/record/seen_from.h"
#include "bench/worker/identity.h"
#include "core/file/replace_file.h"

namespace ptb {
namespace {

constexpr const char* schema = "ptbench.fleet.v1";

std::string plan_text(const FleetPlan& plan) {
    Json json{{"schema", schema}, {"run", encode(plan.run)}, {"facts", Json::object()}};
    for (const auto& [name, value] : plan.facts) json["facts"][name] = value;
    return dump_json(json, 2) + "\n";
}

FleetPlan parse_plan(const std::string& text, const std::string& origin) {
    const Json json = parse_json(text, origin);
    const Where where(origin);
    const auto named = json.is_object() ? json.find("schema") : json.end();
    if (!json.is_object() || named == json.end() || *named != schema)
        throw UsageError(
            fmt::format("{}: not the plan of a fleet: \"schema\" is not \"{}\"", origin, schema));
    FleetPlan plan;
    decode(member(json, where, "run"), Where(where, "run"), plan.run);
    const Where at(where, "facts");
    const Json& facts = member(json, where, "facts");
    if (!facts.is_object()) at.refuse(facts, "an object");
    for (const auto& [name, value] : facts.items()) decode(value, Where(at, name), plan.facts[name]);
    return plan;
}

}  // namespace

Config FleetPlan::config() const { return parse_config(run.settings.json, "plan.json: /run/settings"); }

std::vector<Case> FleetPlan::cases(const std::vector<DeviceInfo>& devices) const {
    std::vector<DeviceInfo> used;
    for (const DeviceInfo& device : devices)
        if (device.excluded.empty()) used.push_back(device);
    return expand(config(), used);
}

FleetPlan plan_here(const RunInfo& run, const std::string& kernel_dir) {
    FleetPlan plan{run, asked_of(run)};
    for (const auto& [name, value] : facts_here(kernel_dir).facts) plan.facts[name] = value;
    return plan;
}

FleetPlan read_plan(const FleetFolder& folder) {
    return parse_plan(read_text(folder.plan()), folder.plan().string());
}

FleetPlan seen_from(const std::filesystem::path& here, FleetPlan plan) {
    ResultFile run;
    run.run = plan.run;
    see_from(here, run, data_dir());
    plan.run = run.run;
    std::erase_if(plan.facts, [](const auto& fact) {
        return fact.first.starts_with("scene ") || fact.first.starts_with("option ");
    });
    plan.facts.merge(asked_of(plan.run));
    return plan;
}

FleetPlan join_plan(const FleetFolder& folder, const FleetPlan& mine, std::vector<std::string>& differing) {
    const std::error_code error = make_new_file(folder.plan(), plan_text(mine));
    if (!error) return mine;
    if (error != std::errc::file_exists)
        throw std::runtime_error(fmt::format("cannot write {}: {}", folder.plan().string(), error.message()));
    FleetPlan plan = read_plan(folder);
    const FleetPlan seen = seen_from(mine.run.folder, plan);
    differing = differences(seen.facts, "there", mine.facts, "here");
    return plan;
}

ResultFile read_header(const std::filesystem::path& journal) {
    std::ifstream in = open_journal(journal);
    return JournalReader(in, journal.string()).header();
}

ResultFile read_node(const FleetFolder& folder, const FleetPlan& plan, const std::string& node) {
    ResultFile run = read_run(folder.journal(node));
    see_from(plan.run.folder, run, data_dir());
    std::vector<DeviceInfo> devices = run.devices;
    for (DeviceInfo& device : devices) device.excluded.clear();  // those that left have records too
    std::vector<Record> ordered = in_plan_order(plan.cases(devices), run.cases);
    if (ordered.size() != run.cases.size())
        throw UsageError(fmt::format("{}: has records of no case of {}, or two of one",
                                     folder.journal(node).string(), folder.plan().string()));
    run.cases = std::move(ordered);
    return run;
}

}  // namespace ptb
