#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/cli/commands.h"
#include "bench/cli/judged.h"
#include "bench/compare/sessions.h"
#include "bench/plan/data_dir.h"

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
    check_outputs(flags.judge);
    show_rows(rows_of(again), title_of(again), flags.judge, table_stream(flags.judge));
    write_page({rows_of(again), title_of(again), {}, read_text(flags.replay)}, flags.judge);
    return exit_code(outcome_of(again));
}

/// The files of each part, whichever way they were given.
struct Files {
    std::vector<std::string> base, now;
};

Files files_of(const CompareFlags& flags) {
    Files files{flags.base, flags.now};
    const std::size_t wanted = flags.history.empty() ? 2 : 1;
    const bool by_place = flags.base.empty() && flags.now.empty() && flags.files.size() == wanted;
    if (by_place && wanted == 2) files.base = {flags.files.front()};
    if (by_place) files.now = {flags.files.back()};
    if (!flags.history.empty()) files.base = flags.history;
    const bool history_alone = flags.history.empty() || (flags.base.empty() && files.now.size() == 1);
    const bool all_used = by_place || flags.files.empty();
    if (files.base.empty() || files.now.empty() || !history_alone || !all_used)
        throw UsageError(
            "compare: allowed: OLD.json NEW.json, or --base FILES --new FILES, or NEW.json --history FILES, "
            "or --replay FILE");
    std::vector<std::string> all = files.base;
    all.insert(all.end(), files.now.begin(), files.now.end());
    if (std::count(all.begin(), all.end(), "-") > 1)
        throw UsageError("compare: found - (stdin) twice; allowed: once");
    return files;
}

std::vector<Session> read_all(const std::vector<std::string>& files) {
    std::vector<Session> sessions;
    for (const std::string& file : files) sessions.push_back(read_session(file));
    return sessions;
}

Config config_of(const std::string& name) {
    return name.empty() ? Config() : load_config(name, data_dir() / "configs");
}

int compare_files(const Options& options) {
    const CompareFlags& flags = options.compare;
    const Files files = files_of(flags);
    check_outputs(flags.judge);
    const Tolerances tolerances = tolerances_of(flags.judge, config_of(flags.config));
    const CompareRules how{[&](const SessionCase& c) { return tolerances.of(c.params.value_or(Case())); },
                           flags.allow_cross, flags.gate_single_session};
    const auto base = read_all(files.base), now = read_all(files.now);
    const Comparison comparison =
        flags.history.empty() ? compare_sessions(base, now, how) : compare_history(base, now.front(), how);
    const auto title =
        fmt::format("base: {}; new: {}", fmt::join(files.base, " "), fmt::join(files.now, " "));
    Outcome outcome;
    add_comparison(outcome, comparison, flags.judge);
    show_comparison(comparison, title, flags.judge, table_stream(flags.judge));
    return exit_code(outcome);
}

}  // namespace

int compare_command(const Options& options) {
    return options.compare.replay.empty() ? compare_files(options) : replay(options.compare);
}

}  // namespace ptb
