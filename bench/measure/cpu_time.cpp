#include "bench/measure/cpu_time.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

namespace ptb {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t counters = 8;  ///< user nice system idle iowait irq softirq steal; guests are in user

Scheduled scheduled_in(const fs::path& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    return parse_scheduled(line);
}

}  // namespace

CpuTicks parse_cpu_ticks(std::string_view line) {
    if (!line.starts_with("cpu ")) return {};
    CpuTicks ticks;
    const char* at = line.data();
    const char* const end = at + line.size();
    at += 4;
    for (std::size_t i = 0; i < counters; ++i) {
        while (at != end && *at == ' ') ++at;
        std::uint64_t value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc()) return {};
        at = next;
        ticks.all += value;
        if (i + 1 == counters) ticks.stolen = value;
    }
    return ticks;
}

double stolen_share(const CpuTicks& before, const CpuTicks& after) {
    if (after.all <= before.all || after.stolen <= before.stolen + 1) return 0;
    return static_cast<double>(after.stolen - before.stolen) / static_cast<double>(after.all - before.all);
}

Scheduled parse_scheduled(std::string_view text) {
    std::istringstream in{std::string(text)};
    Scheduled found;
    return in >> found.ran_ns >> found.waited_ns ? found : Scheduled();
}

Scheduled scheduled_process(const fs::path& root) {
    Scheduled sum;
    std::error_code error;
    for (fs::directory_iterator thread(root / "proc/self/task", error), end; !error && thread != end;
         thread.increment(error)) {
        const Scheduled one = scheduled_in(thread->path() / "schedstat");
        sum.ran_ns += one.ran_ns;
        sum.waited_ns += one.waited_ns;
    }
    return sum;
}

Scheduled scheduled_thread() { return scheduled_in("/proc/thread-self/schedstat"); }

double lost_share(const Scheduled& before, const Scheduled& after, double wall_ns, double cpus) {
    const auto ran = static_cast<double>(after.ran_ns - before.ran_ns);
    const auto waited = static_cast<double>(after.waited_ns - before.waited_ns);
    const double lost = std::min(waited, cpus * wall_ns - ran);
    return ran > 0 && lost > 0 ? lost / (ran + lost) : 0;
}

}  // namespace ptb
