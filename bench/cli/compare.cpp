#include <stdexcept>

#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/judged.h"

namespace ptb {
namespace {

/// Decides again from the data that `ab` stored.
int replay(const CompareFlags& flags) {
    const GateFile gate = read_gate(flags.replay);
    GateFile again = gate;
    again.findings = decide(gate.cases);
    for (std::size_t i = 0; i < gate.cases.size(); ++i) {
        const State stored = gate.findings[i].state, decided = again.findings[i].state;
        if (stored != decided)
            throw std::runtime_error(fmt::format("{}: /findings/{}/state: stored is {}, its data say {}",
                                                 flags.replay, i, to_string(stored), to_string(decided)));
    }
    show_rows(rows_of(again), title_of(again), flags.judge);
    return exit_code(outcome_of(again));
}

}  // namespace

int compare_command(const Options& options) { return replay(options.compare); }

}  // namespace ptb
