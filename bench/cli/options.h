#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/cli/command_text.h"
#include "bench/plan/config.h"

namespace ptb {

/// Flags that every command understands.
struct CommonFlags {
    bool quiet = false, verbose = false;
    std::string color = "auto";  ///< "auto", "always" or "never"
    std::string kernel_dir;
    std::string launcher;          ///< words before a worker's command
    double start_timeout_s = 600;  ///< until a launcher has started one
};

/// Flags of `run`. What was not given stays empty, and the config decides.
struct RunFlags {
    std::vector<std::string> devices, axes;
    bool all_devices = false;
    std::map<std::string, std::string> axis_values;  ///< --spp, --wg, ...: axis name -> values
    std::string config;                              ///< or empty: that of a resumed run, else "quick"
    std::string resume;                              ///< journal or result file of a run to go on with
    std::optional<int> warmup, samples, min_samples, max_samples;
    std::optional<double> max_time_s, timeout_s, max_total_time_s;
    std::optional<std::uint64_t> seed;
    std::string timer;
    bool skip_time = false, dry_run = false, dump_config = false, no_isolate = false, peaks = false;
    std::string json, csv, csv_samples, md, html;  ///< files, or "-" for stdout
    std::string baseline, save_baseline, baseline_dir = "ptbench-baselines";
    std::string fleet;   ///< folder that many nodes share, or empty
    std::string expect;  ///< its nodes, or empty: those of Slurm's job
    bool confirm = false;
    bool no_tuned = false;  ///< ignore what `tune` stored
    std::string tune_file;  ///< where it did, or empty for the user's own
    std::string out;        ///< folder of the run's outputs, or empty for one named after time and config
};

struct ListFlags {
    bool json = false, peaks = false;
};

struct RenderFlags {
    std::vector<std::string> devices;  ///< selectors, as often with commas
    std::string output, aov;
    std::string ranges;  ///< file that says who is to make what, or empty
    std::string fleet;   ///< folder that nodes share, or empty
    std::string expect;  ///< its nodes, or empty: those of Slurm's job
    std::vector<std::string> axes;
    std::map<std::string, std::string> axis_values;
    std::uint64_t seed = 1;
    std::optional<double> time_s;
};

struct WorkerFlags {
    std::string device, nonce;
    bool probe = false;
};

/// How changes are judged and where they are written; of `compare` and `ab`.
struct JudgeFlags {
    std::string tolerance, require_mde;  ///< percentages, or empty
    std::string profile = "shared";      ///< "shared" (5 %) or "dedicated" (2 %)
    bool strict = false, allow_missing = false;
    std::string json, md, html;  ///< files, or "-" for stdout
};

/// Flags of `ab`: what is measured, and in what the sides differ.
struct AbFlags {
    RunFlags run;
    JudgeFlags judge;
    std::string base, now;                  ///< binaries, or empty for this one
    std::string base_kernels, new_kernels;  ///< folders, or empty for the embedded kernels
    std::string base_config, new_config;    ///< or empty for --config
    std::uint64_t shuffle_seed = 1;
};

struct CompareFlags {
    std::vector<std::string> files;               ///< OLD NEW
    std::vector<std::string> base, now, history;  ///< sessions of either side, or those before
    std::string replay;                           ///< a decision of `ab`
    std::string config;                           ///< whose tolerances count, or empty
    bool allow_cross = false, gate_single_session = false;
    JudgeFlags judge;
};

/// Flags of `tune`: the candidates, and where the result is stored.
struct TuneFlags {
    RunFlags run;
};

struct DoctorFlags {
    std::vector<std::string> devices;
    bool no_aa = false;
    std::string json;  ///< file, or "-" for stdout
};

struct ReportFlags {
    std::vector<std::string> files;                ///< result files or journals
    std::string csv, csv_samples, md, html, json;  ///< files, or "-" for stdout
    std::string format;                            ///< of another tool, to stdout
    std::string history;                           ///< folder of result files, or empty
    std::string tolerance;                         ///< of the history's changes, or empty
};

/// A parsed command line.
struct Options {
    enum class Command { run, list, render, compare, ab, tune, doctor, report, worker, text };
    Command command = Command::run;
    std::string text;  ///< of --help or --version: print it and end
    CommonFlags common;
    RunFlags run;
    ListFlags list;
    RenderFlags render;
    CompareFlags compare;
    AbFlags ab;
    TuneFlags tune;
    DoctorFlags doctor;
    ReportFlags report;
    WorkerFlags worker;
};

/// Parses what follows the program's name; PTBENCH_<OPTION> stands in for options of `run` that are not
/// given. Throws UsageError, with the nearest match for a flag that does not exist.
Options parse_options(std::vector<std::string> arguments);

/// What --help says, the program itself first, then its commands.
std::vector<CommandText> command_texts();

/// The config that the flags name, or else that of an `earlier` run, changed as the flags say.
Config configured(const RunFlags& flags, const CommonFlags& common,
                  const std::optional<Config>& earlier = std::nullopt);

/// "10,100" -> the axis "spp=[10,100]"
Axis axis_of_values(const std::string& axis, const std::string& text);

/// The words of a launcher: "srun -w node7".
std::vector<std::string> split_words(const std::string& text);

}  // namespace ptb
