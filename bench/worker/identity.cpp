#include "bench/worker/identity.h"

#include <random>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/record/host.h"
#include "bench/version.h"
#include "core/input/printable.h"
#include "core/integrator/registry.h"
#include "core/source/source.h"

namespace ptb {
namespace {

std::string hash_of(const Integrator& kernel, const std::string& kernel_dir) {
    try {
        return kernel_source(kernel.file(), kernel_dir).hash;
    } catch (const SourceError&) {
        return "not whole";
    }
}

}  // namespace

std::string drawn_nonce() {
    std::random_device random;
    return fmt::format("{:08x}{:08x}", random(), random());
}

WorkerIdentity this_worker(const std::string& nonce) {
    return {nonce, host_name(), ::getpid(), drawn_nonce()};
}

WorkerFacts facts_here(const std::string& kernel_dir) {
    WorkerFacts here;
    here.facts["ptbench"] =
        fmt::format("{} {}{}", version::tool, version::git_sha, version::git_dirty ? " with changes" : "");
    for (const Integrator& kernel : integrators())
        here.facts["kernel " + kernel.id] = hash_of(kernel, kernel_dir);
    return here;
}

std::string text_of(const WorkerIdentity& worker) {
    return fmt::format("process {} on {}", worker.pid, printable(worker.host));
}

void check_one(const WorkerIdentity& worker, const WorkerIdentity& other) {
    if (worker == other) return;
    throw TwoWorkers(fmt::format("--launcher: found two workers, {} and {}; allowed: one, e.g. by srun -n1",
                                 text_of(worker), text_of(other)));
}

}  // namespace ptb
