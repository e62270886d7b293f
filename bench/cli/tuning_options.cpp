#include "bench/cli/option_parts.h"
#include "bench/cli/value_checks.h"
#include "bench/plan/limits.h"

namespace ptb {

void add_tune_flags(CLI::App& app, TuneFlags& flags) {
    flags.run.config = "tune";
    app.add_option("--config", flags.run.config, "config whose cases are the candidates")
        ->capture_default_str();
    list_option(app, "-d,--device", flags.run.devices, devices_help);
    app.add_flag("--all-devices", flags.run.all_devices, "every device of this machine");
    add_axis_flags(app, flags.run.axis_values, false);
    app.add_option("--timeout", flags.run.timeout_s, "a worker silent for longer is killed, seconds")
        ->check(seconds(false));
    app.add_option("--seed", flags.run.seed, "seed of the random numbers of renders and of the race's order")
        ->check(whole_number(0, limits::most_seed));
    app.add_option("--tune-file", flags.run.tune_file, "store here [$XDG_CONFIG_HOME/ptbench/tune.json]")
        ->envname("PTBENCH_TUNE_FILE");
}

void add_doctor_flags(CLI::App& app, DoctorFlags& flags) {
    list_option(app, "-d,--device", flags.devices, devices_help);
    app.add_flag("--no-aa", flags.no_aa, "only look: no device works");
    app.add_option("--json", flags.json, "write what was found here (- for stdout)");
}

}  // namespace ptb
