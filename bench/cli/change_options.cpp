#include "bench/cli/option_parts.h"
#include "bench/cli/value_checks.h"
#include "bench/plan/limits.h"

namespace ptb {
namespace {

void add_judging(CLI::App& app, JudgeFlags& flags) {
    app.add_option("--tolerance", flags.tolerance,
                   "change that passes, e.g. 5%; goes before those of the config");
    app.add_option("--profile", flags.profile, "machine: shared (tolerance 5%) or dedicated (2%)")
        ->check(CLI::IsMember({"shared", "dedicated"}))
        ->capture_default_str();
    app.add_option("--require-mde", flags.require_mde,
                   "exit 5 where the smallest change that could be seen is larger, e.g. 8%");
    app.add_flag("--strict", flags.strict, "exit 5 where a case is inconclusive or only advisory");
    app.add_flag("--allow-missing", flags.allow_missing, "pass although cases of the base have no new time");
    app.add_option("--json", flags.json, "write the result here");
    app.add_option("--md", flags.md, "write the table as Markdown here (- for stdout)");
    app.add_option("--html", flags.html, "write a page here (- for stdout)");
}

/// Files after a flag, as many as stand there.
void files_option(CLI::App& app, const char* flag, std::vector<std::string>& files, const char* help) {
    app.add_option(flag, files, help)->expected(1, -1);
}

}  // namespace

void add_compare_flags(CLI::App& app, CompareFlags& flags) {
    app.add_option("files", flags.files, "OLD.json NEW.json; with --history: NEW.json (- for stdin)");
    files_option(app, "--base", flags.base, "files of the old version, one a session");
    files_option(app, "--new", flags.now, "files of the new version, one a session");
    files_option(app, "--history", flags.history, "files of earlier sessions, of which the last 30 count");
    app.add_option("--replay", flags.replay, "decide again what `ptbench ab` stored here");
    app.add_option("--config", flags.config, "config whose tolerances count");
    app.add_flag("--allow-cross", flags.allow_cross,
                 "compare what is not comparable: ratios only, never exit 3");
    app.add_flag("--gate-single-session", flags.gate_single_session,
                 "exit 3 even if each side is a single session");
    add_judging(app, flags.judge);
}

void add_ab_flags(CLI::App& app, AbFlags& flags) {
    flags.run.config = "ci";
    app.add_option("--base", flags.base, "ptbench of the old version [this one]")->check(CLI::ExistingFile);
    app.add_option("--new", flags.now, "ptbench of the new version [this one]")->check(CLI::ExistingFile);
    app.add_option("--base-kernels", flags.base_kernels, "kernels of the old version [embedded]")
        ->check(CLI::ExistingDirectory);
    app.add_option("--new-kernels", flags.new_kernels, "kernels of the new version [embedded]")
        ->check(CLI::ExistingDirectory);
    app.add_option("--base-config", flags.base_config, "config of the old version [--config]");
    app.add_option("--new-config", flags.new_config, "config of the new version [--config]");
    app.add_option("--config", flags.run.config, "name or file of a config")->capture_default_str();
    list_option(app, "-d,--device", flags.run.devices, devices_help);
    app.add_flag("--all-devices", flags.run.all_devices, "every device of this machine");
    list_option(app, "-a,--axis", flags.run.axes, "axis of the sweep: spp=[10,100]; repeatable");
    add_axis_flags(app, flags.run.axis_values, false);
    app.add_option("--timeout", flags.run.timeout_s, "a worker silent for longer is killed, seconds")
        ->check(seconds(false));
    app.add_option("--timer", flags.run.timer, "auto, event, host")
        ->check(CLI::IsMember({"auto", "event", "host"}));
    app.add_option("--seed", flags.run.seed, "seed of the random numbers of renders")
        ->check(whole_number(0, limits::most_seed));
    app.add_option("--shuffle-seed", flags.shuffle_seed, "seed of the order of the cases")
        ->check(whole_number(0, limits::most_seed))
        ->capture_default_str();
    add_judging(app, flags.judge);
}

}  // namespace ptb
