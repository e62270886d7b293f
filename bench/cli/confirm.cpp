#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/fleet_report.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/journal_writer.h"
#include "bench/cli/prepared.h"
#include "bench/cli/tell.h"
#include "bench/fleet/claim.h"
#include "bench/fleet/judged.h"
#include "bench/fleet/nodes.h"
#include "bench/record/continued.h"
#include "bench/record/host.h"
#include "bench/record/journal.h"
#include "core/source/source.h"

namespace ptb {
namespace {

/// One session of one card of this node.
struct CardSession {
    const Card* card;
    int number;
};

bool is_finished(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored) && !read_header(file).run.finished_at.empty();
}

/// Those of this node that are still to come, in random order.
std::vector<CardSession> sessions_here(const FleetFolder& folder, const Judged& judged,
                                       const std::string& node) {
    std::vector<CardSession> sessions;
    for (const std::size_t i : judged.confirmation.cards) {
        const Card& card = judged.fleet.cards[i];
        for (int number = 1; card.node == node && number <= confirm_sessions; ++number)
            if (!is_finished(session_file(folder, judged.confirmation, card, number)))
                sessions.push_back({&card, number});
    }
    std::mt19937_64 random(std::random_device{}());
    std::shuffle(sessions.begin(), sessions.end(), random);
    return sessions;
}

/// The card as it is called now.
DeviceInfo device_now(const Card& card, const DeviceList& list) {
    for (const DeviceInfo& device : list.devices) {
        const bool same = card.device.uuid.empty()
                              ? device.key == card.device.key && device.name == card.device.name
                              : device.uuid == card.device.uuid;
        if (same && device.excluded.empty()) return device;
    }
    throw NotComparable(fmt::format("--confirm: {} is not there any more", label(card)));
}

/// Measures sessions of cards, each in a worker and with a journal of its own.
class Confirming {
  public:
    Confirming(const Options& options, const FleetFolder& folder, const Judged& judged,
               const DeviceList& list, const Config& config, Stopped stopped)
        : options_(options),
          folder_(folder),
          judged_(judged),
          list_(list),
          config_(config),
          stopped_(std::move(stopped)) {}

    void measure(const CardSession& session) {
        const DeviceInfo device = device_now(*session.card, list_);
        RunPlan plan = empty_plan(config_, options_.run);
        plan.devices = {device};
        plan.cases = in_run_order(expand(config_, plan.devices), plan);
        std::erase_if(plan.cases, [](const Case& c) { return !of_several_devices(c).empty(); });
        Coordinator coordinator(plan, channels(options_, config_, stopped_), stopped_);
        ResultFile result = header(device);
        const auto file = session_file(folder_, judged_.confirmation, *session.card, session.number);
        JournalWriter journal(file, result);
        result.cases = coordinator.run(coordinator.estimate_within_budget(), {&journal});
        outcome_ |= outcome_of(result.cases);
        outcome_.failed |= coordinator.has_given_up();
        if (stopped_()) return;
        result.run.finished_at = utc_now();
        Journal(file, result);
        ++finished_;
    }

    const Outcome& outcome() const { return outcome_; }
    int finished() const { return finished_; }

  private:
    ResultFile header(const DeviceInfo& device) const {
        ResultFile result;
        result.run = run_info({}, config_.name, config_.measure.seed);
        result.run.settings.json = dump_config(config_);
        result.host = host_info();
        result.host.node = this_node();
        result.devices = {device};
        return result;
    }

    const Options& options_;
    const FleetFolder& folder_;
    const Judged& judged_;
    const DeviceList& list_;
    const Config& config_;
    Stopped stopped_;
    Outcome outcome_;
    int finished_ = 0;
};

/// The fleet's plan, which this ptbench must be of.
Config config_here(const FleetFolder& folder) {
    std::error_code unknown;
    const FleetPlan plan = seen_from(std::filesystem::current_path(unknown), read_plan(folder));
    const Config config = plan.config();
    const FleetPlan mine = plan_here(plan.run, config.measure.kernel_dir);
    const auto differing = differences(plan.facts, "there", mine.facts, "here");
    if (differing.empty()) return config;
    throw NotComparable(fmt::format("--confirm: {} measures something else: {}", folder.path.string(),
                                    fmt::join(differing, "; ")));
}

void check_fleet(const FleetFolder& folder) {
    if (!is_fleet(folder.path))
        throw UsageError(
            fmt::format("--confirm: {} has no plan.json: no fleet was measured there", folder.path.string()));
}

/// What became of the sessions, and how many were measured.
struct MeasuredSessions {
    Outcome outcome;
    int count = 0;
};

MeasuredSessions measure_sessions(const Options& options, const FleetFolder& folder, const Judged& judged,
                                  const std::vector<CardSession>& sessions) {
    const Config config = config_here(folder);
    const DeviceList list = find_devices(options.common);
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    std::error_code error;
    std::filesystem::create_directories(folder.path / "confirm" / judged.confirmation.id, error);
    Confirming confirming(options, folder, judged, list, config, stopped);
    for (std::size_t i = 0; i < sessions.size() && !stopped(); ++i) {
        tell(options.common, fmt::format("[{}/{}] session {} of {}", i + 1, sessions.size(),
                                         sessions[i].number, label(*sessions[i].card)));
        confirming.measure(sessions[i]);
    }
    MeasuredSessions measured{confirming.outcome(), confirming.finished()};
    measured.outcome.interrupted = stopped();
    return measured;
}

}  // namespace

int confirm_command(const Options& options) {
    const FleetFolder folder{options.run.fleet};
    check_fleet(folder);
    const std::string node = this_node();
    const NodeClaim claim(folder, node);
    const Judged before = judged(folder, read_fleet(folder));
    const std::vector<CardSession> sessions = sessions_here(folder, before, node);
    MeasuredSessions measured;
    if (!sessions.empty()) measured = measure_sessions(options, folder, before, sessions);
    Outcome outcome = measured.outcome;
    const Judged after = judged(folder, read_fleet(folder));
    put(stdout, fmt::format("{}: {} sessions measured{}; {} of {} are there\n", node, measured.count,
                            outcome.interrupted ? ", then interrupted" : "", after.sessions,
                            after.sessions + after.sessions_to_come));
    if (!outcome.interrupted && after.sessions_to_come == 0) outcome |= show_fleet(options, folder);
    return exit_code(outcome);
}

}  // namespace ptb
