#include "bench/record/continued.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include <fmt/format.h>

#include "bench/record/fingerprint.h"
#include "core/integrator/registry.h"
#include "core/source/source.h"

namespace ptb {
namespace {

std::map<Case, Record> by_case(const std::vector<Record>& records) {
    std::map<Case, Record> found;
    for (const Record& record : records) found.try_emplace(record.params, record);
    return found;
}

std::vector<Record> tried(const std::vector<Record>& records) {
    std::vector<Record> kept;
    std::copy_if(records.begin(), records.end(), std::back_inserter(kept),
                 [](const Record& record) { return record.status != Status::skipped; });
    return kept;
}

RunFingerprint fingerprint_with_kernels(const ResultFile& now, const std::vector<Case>& planned,
                                        const std::string& kernel_dir) {
    RunFingerprint facts = fingerprint_of(now);
    std::set<std::string> kernels;
    for (const Case& c : planned) kernels.insert(c.kernel);
    for (const auto& kernel : kernels)
        facts["kernel " + kernel] = kernel_source(integrator(kernel).file(), kernel_dir).hash;
    return facts;
}

}  // namespace

void go_on(ResultFile& now, const ResultFile& earlier, const std::vector<Case>& planned,
           const std::string& origin, const std::string& kernel_dir) {
    auto changes = differences(fingerprint_of(earlier), "there",
                               fingerprint_with_kernels(now, planned, kernel_dir), "here");
    const std::vector<Record> kept = tried(earlier.cases);
    if (in_plan_order(planned, kept).size() != kept.size())
        changes.emplace_back("plan (records there of no case here, or two of one)");
    if (!changes.empty())
        throw NotComparable(fmt::format("{} is of another run: {}", origin, fmt::join(changes, "; ")));
    const RunInfo began = now.run;
    now.run = earlier.run;
    now.run.resumed_at.push_back(began.started_at);
    for (const std::string& warning : earlier.warnings)
        if (std::find(now.warnings.begin(), now.warnings.end(), warning) == now.warnings.end())
            now.warnings.push_back(warning);
    now.cases = in_plan_order(planned, kept);
}

std::vector<Case> missing(const std::vector<Case>& planned, const std::vector<Record>& records) {
    const auto there = by_case(records);
    std::vector<Case> cases;
    std::copy_if(planned.begin(), planned.end(), std::back_inserter(cases),
                 [&](const Case& c) { return !there.contains(c); });
    return cases;
}

std::vector<Record> in_plan_order(const std::vector<Case>& planned, const std::vector<Record>& records) {
    const auto there = by_case(records);
    std::vector<Record> ordered;
    for (const Case& c : planned)
        if (const auto found = there.find(c); found != there.end()) ordered.push_back(found->second);
    return ordered;
}

}  // namespace ptb
