#include "bench/measure/stop_rule.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/measure/statistics.h"

namespace ptb {

namespace {

constexpr std::size_t window = 3, most_warm_up = 10;
constexpr double most_warm_up_s = 5;

double median(std::span<const double> times_ns) { return describe_times(times_ns).median_ns; }

bool steady(std::span<const double> times_ns) {
    if (times_ns.size() < 2 * window) return false;
    const double last = median(times_ns.last(window));
    const double before = median(times_ns.last(2 * window).first(window));
    return std::abs(last - before) <= precision * std::min(last, before);
}

/// Looks come after `first` samples and then after a quarter more each: looking at every sample would stop at
/// the first interval that is narrow by luck, which then holds the median less often than it says.
bool look_due(int taken, int first) {
    int look = first;
    while (look < taken) look += (look + 3) / 4;
    return look == taken;
}

bool precise(std::span<const double> times_ns) {
    const Statistics s = describe_times(times_ns);
    return s.ci_low_ns && *s.ci_high_ns - *s.ci_low_ns <= 2 * precision * s.median_ns;
}

}  // namespace

bool warm(std::span<const double> times_ns, double elapsed_s, double max_time_s) {
    const bool late = elapsed_s >= std::min(most_warm_up_s, max_time_s / 2);
    return steady(times_ns) || times_ns.size() >= most_warm_up || late;
}

int usual_warmup(double sample_s, double max_time_s) {
    const double fit = std::ceil(std::min(most_warm_up_s, max_time_s / 2) / std::max(sample_s, 1e-9));
    return static_cast<int>(std::min(fit, 2.0 * window));
}

int enough_samples(double sample_s, int min_samples) {
    const int needed = sample_s > 300 ? 1 : sample_s > 30 ? 3 : sample_s > long_sample_s ? 6 : min_samples;
    return std::min(needed, min_samples);
}

std::string StopRule::stop(const Sampled& s) const {
    if (s.taken == 0) return "";
    if (s.sample_s > 30 && s.taken >= enough_samples(s.sample_s, min_samples)) return "low_n";
    const int enough = enough_samples(s.sample_s, min_samples);
    const bool look = look_due(s.taken, enough) || s.taken >= max_samples;
    if (look && static_cast<int>(s.kept_ns.size()) >= enough && precise(s.kept_ns)) return "precision";
    if (s.taken >= max_samples) return "max_samples";
    if (s.elapsed_s + s.sample_s > time_left_s) return "max_total_time";
    if (s.elapsed_s + s.sample_s > max_time_s) return "max_time";
    return "";
}

}  // namespace ptb
