#include "bench/measure/session_clock.h"

#include <algorithm>
#include <map>

#include "bench/measure/causes.h"
#include "bench/measure/statistics.h"

namespace ptb {

namespace {

constexpr std::size_t fewest_probes = 3;

/// Medians of the probes' times, ns, of each device's cases.
std::map<std::string, std::vector<double>> probes_by_device(const std::vector<Record>& records) {
    std::map<std::string, std::vector<double>> medians;
    for (const Record& record : records) {
        std::vector<double> probes_ns;
        for (const TimeSample& sample : record.samples)
            if (sample.probe_ns > 0) probes_ns.push_back(static_cast<double>(sample.probe_ns));
        if (probes_ns.size() >= fewest_probes)
            medians[record.params.device].push_back(describe_times(probes_ns).median_ns);
    }
    return medians;
}

}  // namespace

std::vector<LowClock> low_clocks(const std::vector<Record>& records) {
    std::vector<LowClock> found;
    for (const auto& [device, medians] : probes_by_device(records)) {
        const auto [best, worst] = std::minmax_element(medians.begin(), medians.end());
        const auto low = std::count_if(medians.begin(), medians.end(),
                                       [&, b = *best](double ns) { return ns > clock_limit * b; });
        if (low > 0)
            found.push_back(
                {device, static_cast<int>(low), static_cast<int>(medians.size()), *best / *worst});
    }
    return found;
}

}  // namespace ptb
