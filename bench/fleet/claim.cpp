#include "bench/fleet/claim.h"

#include <fmt/format.h>

#include "bench/fleet/lease.h"
#include "bench/record/journal.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;

void make_folders(const FleetFolder& folder) {
    std::error_code error;
    fs::create_directories(folder.nodes(), error);
    if (error)
        throw UsageError(
            fmt::format("--fleet: cannot create {}: {}", folder.nodes().string(), error.message()));
}

std::optional<ResultFile> run_in(const fs::path& journal) {
    std::error_code ignored;
    return fs::exists(journal, ignored) ? std::optional(read_run(journal)) : std::nullopt;
}

[[noreturn]] void refuse(const std::string& node, const std::string& by) {
    throw NodeInUse(
        fmt::format("--fleet: {} is being measured by {}; allowed: one ptbench a node, as with srun's "
                    "--ntasks-per-node=1",
                    node, by));
}

}  // namespace

NodeClaim::NodeClaim(const FleetFolder& folder, const std::string& node) {
    make_folders(folder);
    const bool free = lock_.take_file(folder.lock(node));
    earlier_ = run_in(folder.journal(node));
    const std::optional<Lease> lease = earlier_ ? earlier_->run.lease : std::nullopt;
    const bool finished = earlier_ && !earlier_->run.finished_at.empty();
    if (!free) refuse(node, lease && !finished ? text_of(*lease) : "another process");
    if (lease && !finished && is_living(*lease)) refuse(node, text_of(*lease));
}

}  // namespace ptb
