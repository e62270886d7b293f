#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "bench/compare/evidence.h"
#include "bench/doctor/remarks.h"

namespace ptb {
namespace {

using Weight = Remark::Weight;

constexpr double coarse_ns = 1e5;      ///< a timer's ticks: work of 100 of them takes 10 ms
constexpr double short_sighted = 0.1;  ///< a gate that sees only larger changes is of little use
constexpr double sharp = 0.04;         ///< one that sees smaller ones can do with a narrow tolerance

}  // namespace

std::vector<Remark> driver_remarks(const DeviceList& list) {
    std::vector<Remark> remarks;
    for (const BrokenIcd& broken : list.broken)
        remarks.push_back(
            {Weight::note, "driver", "", fmt::format("{} cannot be used: {}", broken.icd, broken.reason),
             fmt::format("install it anew or remove it; `dpkg -S {}` names its package", broken.icd)});
    for (const DeviceInfo& device : list.devices)
        if (!device.excluded.empty())
            remarks.push_back({Weight::note, "driver", device.key,
                               fmt::format("not used: {}", device.excluded),
                               fmt::format("one driver of a device is enough; `dpkg -S {}` names the package",
                                           device.icd)});
    if (remarks.empty() && !list.devices.empty())
        remarks.push_back(
            {Weight::fine, "driver", "", "every driver answers, every device is there once", ""});
    return remarks;
}

std::uint64_t shown_tick_ns(const std::vector<Block>& blocks) {
    std::uint64_t tick = 0;
    for (const Block& block : blocks)
        for (const Round& round : block.rounds)
            for (const std::int64_t ns : round.kernel_ns)
                tick = std::gcd(tick, static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0)));
    return tick;
}

Remark timer_remark(const SelfComparison& aa) {
    const std::string& key = aa.device.key;
    if (!aa.device.profiling)
        return {Weight::warning, "timer", key, "the device cannot time its work (no profiling)",
                "it is timed by the host's clock, which sees launches too: take cases of 10 ms or more "
                "(--spp, --size)"};
    if (!aa.timer_reason.empty())
        return {Weight::warning, "timer", key,
                fmt::format("event times cannot be believed: {}", aa.timer_reason),
                "it is timed by the host's clock; look for a newer driver (`ptbench list` shows this one)"};
    if (aa.gate.timer == "host")
        return {Weight::note, "timer", key, "at times its clock and the host's disagree: a busy machine",
                "`ptbench ab` then judges by the host's clock; end what `top` shows"};
    const std::uint64_t tick = shown_tick_ns(aa.gate.screen), claimed = aa.device.timer_resolution_ns;
    const std::string seen =
        tick == 0 ? fmt::format("claims a resolution of {} ns", claimed)
                  : fmt::format("claims a resolution of {} ns, its times advance by {} ns", claimed, tick);
    if (static_cast<double>(std::max(tick, claimed)) >= coarse_ns)
        return {Weight::warning, "timer", key, seen, "take cases of 100 ticks or more (--spp, --size)"};
    if (tick > 2 * claimed && claimed > 0)
        return {Weight::note, "timer", key, seen, "short renders are measured many at a time; nothing to do"};
    return {Weight::fine, "timer", key, seen, ""};
}

Remark self_remark(const SelfComparison& aa) {
    const std::string& key = aa.device.key;
    if (!aa.gate.not_measured.empty())
        return {Weight::warning, "A/A", key, "nothing measured: " + aa.gate.not_measured,
                fmt::format("`ptbench run -d {}` shows more", key)};
    const double percent = 100 * (aa.finding.evidence.ratio() - 1);
    const std::string seen =
        fmt::format("two equal sides differ by {:.1f} % in {} blocks", std::abs(percent), aa.finding.n);
    if (aa.finding.state != State::regressed && aa.finding.state != State::improved)
        return {Weight::fine, "A/A", key, seen, ""};
    return {Weight::warning, "A/A", key, seen + ", which would be called a change",
            "run `ptbench doctor` again; if it stays, do not gate on this machine"};
}

double smallest_change(const SelfComparison& aa, double tolerance) {
    return smallest_effect(tolerance, aa.finding.evidence.standard_error);
}

Remark sight_remark(const SelfComparison& aa) {
    const double shared = smallest_change(aa, 0.05), dedicated = smallest_change(aa, 0.02);
    const std::string seen = fmt::format(
        "the smallest change that `ptbench ab` sees is {:.1f} %, {:.1f} % with --profile dedicated",
        100 * shared, 100 * dedicated);
    if (shared > short_sighted)
        return {Weight::warning, "smallest change", aa.device.key, seen,
                "quieten the machine (see above), take longer cases (--spp), and let `--require-mde 10%` say "
                "when it is too noisy"};
    if (dedicated <= sharp)
        return {Weight::fine, "smallest change", aa.device.key, seen + "; quiet enough for it", ""};
    return {Weight::fine, "smallest change", aa.device.key, seen, ""};
}

}  // namespace ptb
