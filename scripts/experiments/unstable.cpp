// How often the measuring method calls a row unstable that is right, and how often one that is wrong, on
// simulated samples: time, clock probe and CPU time that others took.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/measure/causes.h"
#include "bench/measure/method.h"

namespace {

using namespace ptb;

constexpr int cases = 1000;
constexpr double wrong_by = 0.05, render_s = 0.15;

/// How a sample is disturbed: factors on its time, and what a probe and the scheduler's counters show of it.
struct Moment {
    double slow = 1, probe = 1;
    double lost = 0;  ///< share of CPU time
};

using Random = std::mt19937;
double uniform(Random& random) { return std::uniform_real_distribution<>()(random); }

/// What happens during one case: a state that changes from sample to sample.
using Course = std::function<Moment(int number)>;

struct Surrounding {
    const char* name;
    double noise;
    std::function<Course(Random&)> course;
};

Moment clock(double slow) { return {slow, slow, 0}; }
/// Time that another program takes shows in the counters, unless it runs outside of the virtual machine.
Moment neighbour(double slow, bool seen = true) { return {slow, 1, seen ? 1 - 1 / slow : 0}; }

Course steady(Moment moment) {
    return [moment](int) { return moment; };
}

/// A neighbour that comes and goes: busy for a share of the samples, for some at a time.
Course bursts(Random& random, double share, bool seen) {
    return [&random, share, seen, busy = false](int) mutable {
        constexpr double ends = 0.2;
        const double begins = ends * share / (1 - share);
        busy = busy ? uniform(random) >= ends : uniform(random) < begins;
        return busy ? neighbour(1.1 + 0.6 * uniform(random), seen) : Moment();
    };
}

Course clock_step(Random& random) {
    const int at = 6 + static_cast<int>(30 * uniform(random));  // warm-ups are samples, too
    const double slow = 1.05 + 0.35 * uniform(random);
    return [at, slow](int number) { return clock(number < at ? 1 : slow); };
}

Course hiccups(Random& random) {
    return [&random](int) { return Moment{1, uniform(random) < 0.25 ? 1.23 : 1, 0}; };
}

const Surrounding surroundings[] = {
    {"quiet", 0.01, [](Random&) { return steady({}); }},
    {"quiet, noise of 5 %", 0.05, [](Random&) { return steady({}); }},
    {"a clock that stays 30 % low", 0.01, [](Random&) { return steady(clock(1.3)); }},
    {"probes that hiccup, one in four", 0.01, hiccups},
    {"a clock that falls by 5 to 40 % within the case", 0.01, clock_step},
    {"a neighbour in a tenth of the samples", 0.01, [](Random& r) { return bursts(r, 0.1, true); }},
    {"in four of ten", 0.01, [](Random& r) { return bursts(r, 0.4, true); }},
    {"in seven of ten", 0.01, [](Random& r) { return bursts(r, 0.7, true); }},
    {"in all, taking 3 to 50 % of the CPUs", 0.01,
     [](Random& r) { return steady(neighbour(1 / (0.97 - 0.47 * uniform(r)))); }},
    {"outside of the virtual machine, in four of ten", 0.01, [](Random& r) { return bursts(r, 0.4, false); }},
    {"outside, in all", 0.01, [](Random& r) { return steady(neighbour(1.1 + 0.4 * uniform(r), false)); }},
};

struct Row {
    bool wrong, unstable;
};

/// One case; it is right at the clock that most of its samples had.
Row measured(const Surrounding& around, Random& random) {
    const Course course = around.course(random);
    std::normal_distribution<> noise(0, around.noise);
    double now_s = 0;
    int number = 0;
    std::vector<double> clocks;
    const auto take = [&](const std::string&, int) {
        const Moment moment = course(number++);
        TimedRender timed;
        const double s = render_s * moment.slow * std::exp(noise(random));
        timed.time.kernel_ns = timed.time.sum_ns = timed.time.host_ns = std::llround(1e9 * s);
        timed.time.probe_ns = std::llround(30e3 * moment.probe * std::exp(0.002 * noise(random)));
        if (moment.lost > loss_limit) timed.time.cause = cause::busy;
        now_s += s;
        clocks.push_back(moment.probe == moment.slow ? moment.slow : 1);
        return timed;
    };
    TimerWatch timer("auto");
    Method method;
    method.predicted_s = render_s;
    method.stop.max_time_s = 10;
    const Measurement measurement = measure(method, timer, take, [&] { return now_s; });
    clocks.erase(clocks.begin(), clocks.end() - static_cast<std::ptrdiff_t>(measurement.samples.size()));
    std::nth_element(clocks.begin(), clocks.begin() + static_cast<std::ptrdiff_t>(clocks.size() / 2),
                     clocks.end());
    const double right_ns = 1e9 * render_s * clocks[clocks.size() / 2];
    return {std::abs(describe(measurement, timer).median_ns / right_ns - 1) > wrong_by,
            !unstable_reason(measurement, timer, {true, {}}).empty()};
}

std::string share(int part, int of) { return of == 0 ? "-" : fmt::format("{:.1f} %", 100.0 * part / of); }

void print_row(const Surrounding& around, unsigned seed) {
    Random random(seed);
    int wrong = 0, wrong_told = 0, right_told = 0;
    for (int i = 0; i < cases; ++i) {
        const Row row = measured(around, random);
        wrong += row.wrong ? 1 : 0;
        wrong_told += row.wrong && row.unstable ? 1 : 0;
        right_told += !row.wrong && row.unstable ? 1 : 0;
    }
    fmt::print("| {} | {} | {} | {} | {} |\n", around.name, wrong, share(wrong_told, wrong), cases - wrong,
               share(right_told, cases - wrong));
}

}  // namespace

int main(int argc, char** argv) {
    const auto seed = argc > 1 ? static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10)) : 1u;
    fmt::print("| disturbed by | wrong rows | unstable | right rows | unstable |\n");
    fmt::print("| --- | ---: | ---: | ---: | ---: |\n");
    for (const Surrounding& around : surroundings) print_row(around, seed);
}
