#include "bench/record/json.h"
#include "bench/report/formats/formats.h"
#include "bench/report/formats/passed.h"

namespace ptb {
namespace {

Json context(const ResultFile& result) {
    return {{"date", result.run.started_at},
            {"host_name", result.host.hostname},
            {"executable", "ptbench " + result.run.tool_version},
            {"num_cpus", result.host.cores},
            {"mhz_per_cpu", 0},
            {"cpu_scaling_enabled", false},
            {"caches", Json::array()},
            {"load_avg", {result.host.load_1min}},
            {"library_build_type", "release"}};
}

Json entry(const Passed& p, std::size_t index) {
    Json json = {{"name", p.name},
                 {"run_name", p.name},
                 {"run_type", "iteration"},
                 {"repetitions", p.times_ns.size()},
                 {"repetition_index", index},
                 {"threads", 1},
                 {"iterations", 1},
                 {"real_time", p.times_ns[index]},
                 {"cpu_time", p.times_ns[index]},  // readers want one; a device's CPU time is its time
                 {"time_unit", "ns"}};
    if (const auto noise = p.noise()) {  // counters
        json["relMSE"] = noise->rel_mse;
        json["efficiency"] = 1 / (noise->rel_mse * p.times_ns[index] * 1e-9);
    }
    return json;
}

}  // namespace

std::string google_benchmark(const ResultFile& result) {
    Json list = Json::array();
    for (const Passed& p : passed(result))
        for (std::size_t i = 0; i < p.times_ns.size(); ++i) list.push_back(entry(p, i));
    return dump_json({{"context", context(result)}, {"benchmarks", list}}, 2) + "\n";
}

}  // namespace ptb
