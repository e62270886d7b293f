#include "bench/fleet/lease.h"

#include <charconv>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/record/host.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

std::string boot_id() {
    std::string id = kernel_text("/proc/sys/kernel/random/boot_id");
    return id.substr(0, id.find('\n'));
}

/// Clock ticks from the machine's start to the process'; 0 where there is none, or only what waits to be
/// reaped. The 22nd field, counted from behind the name, which may hold anything; the third is the state.
std::uint64_t started_at_tick(int pid) {
    const std::string stat = kernel_text(fmt::format("/proc/{}/stat", pid));
    std::size_t at = stat.rfind(')');
    if (at == std::string::npos || stat.compare(at, 3, ") Z") == 0) return 0;
    for (int field = 2; field < 22 && at != std::string::npos; ++field) at = stat.find(' ', at + 1);
    std::uint64_t ticks = 0;
    if (at != std::string::npos) std::from_chars(stat.data() + at + 1, stat.data() + stat.size(), ticks);
    return ticks;
}

}  // namespace

Lease lease_of(int pid) {
    const char* const job = std::getenv("SLURM_JOB_ID");
    return {boot_id(), pid, started_at_tick(pid), job == nullptr ? "" : job};
}

Lease this_lease() { return lease_of(::getpid()); }

bool is_living(const Lease& lease) {
    const std::uint64_t started = started_at_tick(lease.pid);
    return lease.boot_id == boot_id() && started != 0 && started == lease.started_at_tick;
}

std::string text_of(const Lease& lease) {
    return fmt::format("process {}{}", lease.pid,
                       lease.job.empty() ? "" : fmt::format(" of job {}", printable(lease.job)));
}

}  // namespace ptb
