#include "bench/cli/options.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include <CLI/CLI.hpp>
#include <boost/tokenizer.hpp>
#include <fmt/format.h>

#include "bench/cli/exit_code.h"
#include "bench/cli/option_parts.h"
#include "bench/cli/value_checks.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/limits.h"
#include "bench/report/formats/formats.h"
#include "bench/version.h"
#include "core/input/nearest.h"
#include "core/input/printable.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

constexpr auto description =
    "ptbench: how fast OpenCL devices trace light.\n"
    "Without a command it runs a config; `ptbench run` is the same.\n";

std::string footer() {
    std::string codes;
    for (const auto& [code, meaning] : exit_code_meanings) {
        codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", code, meaning);
    }
    return "Options of a run can also be set as PTBENCH_<OPTION>, e.g. PTBENCH_CONFIG=thesis.\nExit codes: " +
           codes + ".";
}

/// Axis name and its flag, in the order of --help.
struct AxisFlag {
    const char *axis, *flag, *help;
};
constexpr AxisFlag axis_flags[] = {
    {"kernel", "--kernel", "pt, thesis, ..."},
    {"scene", "--scene", "name of a scene, or a scene file; a comma in its path is \\,"},
    {"size", "--size", "pixels: 1024 or 640x480"},
    {"spp", "--spp", "samples per pixel: 10,100,1000"},
    {"path_length", "--path-length", "most segments in a path"},
    {"work_group", "--wg", "work-group: implicit, 64, 16x16"},
    {"lanes", "--lanes", "rays traced together by a work-item: auto, 1, 4, 8, 16, 32"},
    {"together", "--together", "who works at the same time, each at its own case: no, gpus, all"},
};

std::string variable_of(std::string flag) {
    flag = flag.substr(flag.rfind("--") + 2);
    for (char& c : flag) c = c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return "PTBENCH_" + flag;
}

template <class Value>
CLI::Option* option(CLI::App& app, const std::string& flags, Value& value, const std::string& help) {
    return app.add_option(flags, value, help)->envname(variable_of(flags));
}

CLI::Option* flag(CLI::App& app, const std::string& flags, bool& value, const std::string& help) {
    return app.add_flag(flags, value, help)->envname(variable_of(flags));
}

}  // namespace

void list_option(CLI::App& app, const std::string& flags, std::vector<std::string>& values,
                 const char* help) {
    option(app, flags, values, help)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->expected(1);
}

void add_axis_flags(CLI::App& app, std::map<std::string, std::string>& values, bool of_run) {
    for (const AxisFlag& each : axis_flags) {
        const std::string axis = each.axis;
        if (axis == "together" && !of_run) continue;
        auto* const added = app.add_option_function<std::string>(
            each.flag, [&values, axis](const std::string& text) { values[axis] = text; }, each.help);
        added->type_name("VALUES")->group("Axes");
        if (of_run) added->envname(variable_of(each.flag));
    }
}

void add_common_flags(CLI::App& app, CommonFlags& flags) {
    flag(app, "-q,--quiet", flags.quiet, "no progress, no hints");
    flag(app, "-v,--verbose", flags.verbose, "also show excluded devices, broken drivers and build logs");
    option(app, "--color", flags.color, "auto, always, never")
        ->check(CLI::IsMember({"auto", "always", "never"}));
    option(app, "--kernel-dir", flags.kernel_dir, "kernels from this folder instead of the embedded ones")
        ->check(CLI::ExistingDirectory);
    option(app, "--launcher", flags.launcher,
           "words before a worker's command, which start one: \"srun -n1 -w node7\"");
    option(app, "--start-timeout", flags.start_timeout_s,
           "how long a launcher may take to start a worker, e.g. in a queue, seconds")
        ->check(seconds(false))
        ->capture_default_str();
}

namespace {

void add_measuring(CLI::App& app, RunFlags& flags) {
    option(app, "-w,--warmup", flags.warmup, "untimed samples before the timed ones [until steady]")
        ->check(whole_number(0, limits::most_repetitions));
    option(app, "--samples", flags.samples, "timed samples of a case: both of the next two")
        ->check(whole_number(1, limits::most_repetitions));
    option(app, "--min-samples", flags.min_samples, "timed samples before the median may be precise enough")
        ->check(whole_number(1, limits::most_repetitions));
    option(app, "--max-samples", flags.max_samples, "timed samples of a case, at most")
        ->check(whole_number(1, limits::most_repetitions));
    option(app, "--max-time", flags.max_time_s, "no further sample of a case after these seconds")
        ->check(seconds(false));
    option(app, "--timeout", flags.timeout_s, "a worker silent for longer is killed, seconds")
        ->check(seconds(false));
    option(app, "--max-total-time", flags.max_total_time_s,
           "budget of the run in seconds, 0 for none: shared by its devices, on each for little work first")
        ->check(seconds(true));
    option(app, "--seed", flags.seed, "seed of the random numbers")
        ->check(whole_number(0, limits::most_seed));
    option(app, "--timer", flags.timer, "auto, event, host")->check(CLI::IsMember({"auto", "event", "host"}));
    flag(app, "--skip-time", flags.skip_time, "validate only");
    flag(app, "--no-isolate", flags.no_isolate, "measure in this process, for profilers and debuggers");
}

void add_outputs(CLI::App& app, RunFlags& flags) {
    option(app, "--json", flags.json, "also write the result file here (- for stdout)");
    option(app, "--csv", flags.csv, "also write CSV here (- for stdout)");
    option(app, "--csv-samples", flags.csv_samples, "write every sample as CSV here (- for stdout)");
    option(app, "--md", flags.md, "also write Markdown here (- for stdout)");
    option(app, "--html", flags.html, "also write a page here (- for stdout)");
    option(app, "--out", flags.out, "folder of all outputs [ptbench-results/TIME-CONFIG]");
}

void add_baselines(CLI::App& app, RunFlags& flags) {
    option(app, "--baseline", flags.baseline, "compare with this baseline: a name or a result file");
    option(app, "--save-baseline", flags.save_baseline, "keep the result as the baseline of this name");
    option(app, "--baseline-dir", flags.baseline_dir, "folder of baselines")->capture_default_str();
}

/// A node of a fleet writes its journal and no other output; what it takes part in is of the whole fleet.
void add_fleet(CLI::App& app, RunFlags& flags) {
    auto* const fleet =
        option(app, "--fleet", flags.fleet, "take part in measuring many nodes, which share this folder");
    option(app, "--expect", flags.expect, "the fleet's nodes: n1,n[3-7] [those of Slurm's job]")
        ->needs(fleet);
    flag(app, "--confirm", flags.confirm, "measure the fleet's suspects again, beside others")->needs(fleet);
    for (const char* const other : {"--resume", "--out", "--json", "--csv", "--csv-samples", "--md", "--html",
                                    "--launcher", "--no-isolate", "--baseline", "--save-baseline"})
        fleet->excludes(app.get_option(other));
}

void add_run(CLI::App& app, RunFlags& flags, bool& list) {
    option(app, "--config", flags.config, "name or file of a config [quick]");
    list_option(app, "-d,--device", flags.devices, devices_help);
    flag(app, "--all-devices", flags.all_devices, "every device of this machine");
    list_option(app, "-a,--axis", flags.axes,
                "axis of the sweep: spp=[10,100], (spp,size)=[(10,64),(20,32)]; repeatable");
    add_axis_flags(app, flags.axis_values, true);
    add_measuring(app, flags);
    add_outputs(app, flags);
    option(app, "--resume", flags.resume, "go on with the run of this journal or result file")
        ->check(CLI::ExistingFile);
    add_baselines(app, flags);
    flag(app, "--no-tune", flags.no_tuned, "ignore what `ptbench tune` stored");
    option(app, "--tune-file", flags.tune_file, "where it did [$XDG_CONFIG_HOME/ptbench/tune.json]");
    flag(app, "--peaks", flags.peaks, "also measure what the devices can do at most");
    flag(app, "--dry-run", flags.dry_run, "print the plan with its predicted cost");
    flag(app, "--dump-config", flags.dump_config, "print the config and end");
    app.add_flag("-l,--list", list, "same as `ptbench list`");
}

std::vector<std::string> flags_of(const CLI::Option& option) {
    std::vector<std::string> flags;
    for (const auto& name : option.get_snames()) flags.push_back("-" + name);
    for (const auto& name : option.get_lnames()) flags.push_back("--" + name);
    return flags;
}

/// CLI11 says "TEXT", "TEXT:DIR" or "TEXT:{auto,always,never}".
OptionText option_text(const CLI::Option& option) {
    OptionText text;
    text.flags = flags_of(option);
    text.help = option.get_description();
    text.variable = option.get_envname();
    if (option.get_expected_max() == 0) return text;
    const std::string type = option.get_type_name();
    const auto colon = type.find(':');
    text.value = type.substr(0, colon);
    const std::string check = colon == std::string::npos ? "" : type.substr(colon + 1);
    text.is_folder = check == "DIR";
    if (check.starts_with("{")) text.choices = CLI::detail::split(check.substr(1, check.size() - 2), ',');
    return text;
}

/// An empty value is refused alike wherever an option takes one. What checks numbers says better what is
/// allowed, so it comes first.
void refuse_empty_values(CLI::App& app) {
    for (CLI::Option* const each : app.get_options()) {
        const OptionText text = option_text(*each);
        if (text.value.empty()) continue;
        const auto check = not_empty(text.choices.empty() ? "a value that is not empty: " + text.help
                                                          : fmt::format("{}", fmt::join(text.choices, ", ")));
        const bool number = text.value != "TEXT" && text.value != "VALUES";
        number ? each->check(check) : each->transform(check);
    }
}

/// CLI11 takes a variable that is empty, and from version 2.4 on one that is not allowed, for one that is not
/// set.
void refuse_missed_variables(CLI::App& app) {
    for (CLI::Option* const each : app.get_options()) {
        const char* const value = std::getenv(each->get_envname().c_str());
        if (value == nullptr || each->count() > 0) continue;
        const bool is_flag = each->get_expected_max() == 0;
        if (is_flag && *value != '\0') continue;
        if (is_flag) throw CLI::ValidationError(each->get_name(), "found \"\"; allowed: true, false");
        each->add_result(value);
        each->run_callback();
    }
}

/// The command line's grammar, bound to `options`.
struct Grammar {
    CLI::App app{description, "ptbench"};
    CLI::App *list, *render, *compare, *ab, *tune, *doctor, *report, *worker;
    bool list_flag = false;

    explicit Grammar(Options& options) {
        app.footer(footer());
        add_run(app, options.run, list_flag);
        add_common_flags(app, options.common);
        add_fleet(app, options.run);
        list = app.add_subcommand("list", "devices, kernels, scenes and configs");
        list->add_flag("--json", options.list.json, "as JSON");
        list->add_flag("--peaks", options.list.peaks, "also measure what the devices can do at most");
        add_common_flags(*list, options.common);
        add_render(options.render);
        add_common_flags(*render, options.common);
        compare = app.add_subcommand("compare", "what changed between result files");
        add_compare_flags(*compare, options.compare);
        add_common_flags(*compare, options.common);
        ab = app.add_subcommand("ab", "measure two versions alternately, and decide what changed");
        add_ab_flags(*ab, options.ab);
        add_common_flags(*ab, options.common);
        tune = app.add_subcommand("tune",
                                  "race lane widths and work-groups of a kernel; the best serve later runs");
        add_tune_flags(*tune, options.tune);
        add_common_flags(*tune, options.common);
        doctor = app.add_subcommand("doctor",
                                    "what disturbs measurements here, and how small a change can be seen");
        add_doctor_flags(*doctor, options.doctor);
        add_common_flags(*doctor, options.common);
        report = app.add_subcommand("report", "show stored results: here, as a page, in other formats");
        add_report_flags(*report, options.report);
        add_common_flags(*report, options.common);
        worker = app.add_subcommand("worker", "answer requests on stdin; started by ptbench itself");
        worker->group("");
        worker->add_option("--device", options.worker.device, "key of the device");
        worker->add_option("--nonce", options.worker.nonce, "names this process among others");
        worker->add_flag("--probe", options.worker.probe, "print the devices and end");
        for (auto* command : {&app, list, render, compare, ab, tune, doctor, report, worker}) {
            command->set_version_flag("--version", std::string("ptbench ") + version::tool);
            command->allow_extras();
            refuse_empty_values(*command);
        }
    }

    void add_render(RenderFlags& flags) {
        render = app.add_subcommand("render", "make one picture");
        auto* const devices =
            render
                ->add_option("-d,--device", flags.devices,
                             "as of a run; several make one picture together: gpu, or 0,1 [the first]")
                ->allow_extra_args(false)
                ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                ->expected(1);
        render->add_option("-o,--output", flags.output, "file: .exr, .pfm, .png or .ppm");
        auto* const seed = render->add_option("--seed", flags.seed, "seed of the random numbers")
                               ->check(whole_number(0, limits::most_seed))
                               ->capture_default_str();
        auto* const time =
            render
                ->add_option("--time", flags.time_s,
                             "seconds to render for, in place of --spp: ends when every pixel has as many "
                             "samples, and says how many")
                ->check(seconds(false));
        render
            ->add_option("--aov", flags.aov,
                         "what pixels show: radiance; cost: what a sample takes of a tree of triangles, "
                         "nodes as a heat map, in .exr and .pfm nodes, triangles and rays; of gradients "
                         "primal, dx, dy: radiance without them, and how much more the pixel to the right "
                         "has, and the one below, by size in .png and .ppm [radiance]")
            ->check(CLI::IsMember(std::vector<std::string>(aov_names.begin(), aov_names.end())));
        render
            ->add_option("--ranges", flags.ranges,
                         "repeat a picture of several devices, by the file beside it: the same work, and who "
                         "did what")
            ->check(CLI::ExistingFile)
            ->excludes(devices)
            ->excludes(seed)
            ->excludes(time);
        auto* const fleet = render->add_option(
            "--fleet", flags.fleet,
            "one picture by several nodes, which share this folder; the last one writes it");
        fleet->excludes(time)->excludes(render->get_option("--ranges"));
        render->add_option("--expect", flags.expect, "the nodes: n1,n[3-7] [those of Slurm's job]")
            ->needs(fleet);
        render->add_option("-a,--axis", flags.axes, "an axis' value: pixel_filter=centre; repeatable")
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
            ->expected(1);
        add_axis_flags(*render, flags.axis_values, false);
    }

    CLI::App& used() {
        for (auto* command : {list, render, compare, ab, tune, doctor, report, worker}) {
            if (command->parsed()) return *command;
        }
        return app;
    }
};

std::vector<std::string> known_flags(const CLI::App& app) {
    std::vector<std::string> flags;
    for (const CLI::Option* each : app.get_options()) {
        for (auto& flag : flags_of(*each)) flags.push_back(std::move(flag));
    }
    return flags;
}

/// What the value of an option names, where that is not just what is checked of it.
void add_names(OptionText& text) {
    const std::string flag = text.flags.empty() ? "" : text.flags.back();
    if (flag == "--kernel") text.names = integrator_ids();
    if (flag == "--format") text.names = format_names();
    if (flag == "--scene") text.names = scene_names();
    if (flag.ends_with("config")) text.names = config_names();
    text.is_file = flag == "--scene" || flag.ends_with("config");
}

CommandText command_text(const CLI::App& app) {
    CommandText text{app.get_name(), app.get_description(), {}};
    for (const CLI::Option* each : app.get_options()) {
        text.options.push_back(option_text(*each));
        add_names(text.options.back());
    }
    return text;
}

void refuse_leftovers(Grammar& grammar, const std::string& first_word) {
    const auto left = grammar.app.remaining(true);
    if (left.empty()) return;
    const std::string word = left.front().substr(0, left.front().find('='));
    if (word.starts_with("-")) {
        throw UsageError(fmt::format("unknown option {}{}", printable(word),
                                     did_you_mean(word, known_flags(grammar.used()))));
    }
    if (word != first_word) throw UsageError(fmt::format("unexpected word \"{}\"", printable(left.front())));
    const std::vector<std::string> commands{"run", "list", "render", "compare",
                                            "ab",  "tune", "doctor", "report"};
    throw UsageError(fmt::format("unknown command {}{}; commands: {}", printable(word),
                                 did_you_mean(word, commands), fmt::join(commands, ", ")));
}

/// What stands before a command would be of `run`, and would do nothing.
void refuse_late_command(Grammar& grammar, const std::string& first_word) {
    const std::string command = grammar.used().get_name();
    if (&grammar.used() == &grammar.app || command == first_word) return;
    throw UsageError(fmt::format("{}: a command comes first: ptbench {} [OPTIONS]", command, command));
}

Options::Command command_of(const Grammar& grammar) {
    if (grammar.list->parsed() || grammar.list_flag) return Options::Command::list;
    if (grammar.render->parsed()) return Options::Command::render;
    if (grammar.compare->parsed()) return Options::Command::compare;
    if (grammar.ab->parsed()) return Options::Command::ab;
    if (grammar.tune->parsed()) return Options::Command::tune;
    if (grammar.doctor->parsed()) return Options::Command::doctor;
    if (grammar.report->parsed()) return Options::Command::report;
    return grammar.worker->parsed() ? Options::Command::worker : Options::Command::run;
}

/// CLI11's message on one line, in words; with the variable when that is where the value came from.
std::string reason_of(const CLI::ParseError& error, const std::vector<std::string>& arguments) {
    std::string text = error.what();
    text = printable(text.substr(0, text.find('\n')));
    const std::string flag = text.substr(0, text.find(':'));
    if (text.find(": At Most 1 required") != std::string::npos) return flag + ": given twice; allowed: once";
    if (text.ends_with(" required TEXT missing")) return flag + ": its value is missing";
    const auto gives = [&](const std::string& word) { return word.starts_with(flag); };
    if (!flag.starts_with("--") || std::any_of(arguments.begin(), arguments.end(), gives)) return text;
    const char* const value = std::getenv(variable_of(flag).c_str());
    return value == nullptr ? text : fmt::format("{} ({})", text, variable_of(flag));
}

/// "--csv=" as "--csv" and "": CLI11 would take the next word for the value.
std::vector<std::string> with_empty_values(const std::vector<std::string>& arguments) {
    std::vector<std::string> words;
    for (const std::string& word : arguments) {
        const bool empty_value = word.starts_with("--") && word.find('=') == word.size() - 1;
        words.push_back(empty_value ? word.substr(0, word.size() - 1) : word);
        if (empty_value) words.emplace_back();
    }
    return words;
}

}  // namespace

Options parse_options(std::vector<std::string> arguments) {
    arguments = with_empty_values(arguments);
    const std::string first_word = arguments.empty() ? "" : arguments.front();
    if (first_word == "run") arguments.erase(arguments.begin());
    std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 takes a vector in
    Options options;
    Grammar grammar(options);
    try {
        auto words = arguments;  // which CLI11 empties
        grammar.app.parse(words);
        refuse_leftovers(grammar, first_word);
        refuse_late_command(grammar, first_word);
        refuse_missed_variables(grammar.used());
        options.command = command_of(grammar);
    } catch (const CLI::CallForHelp&) {
        options.text = grammar.used().help(&grammar.used() == &grammar.app ? "" : "ptbench");
    } catch (const CLI::CallForVersion& version) {
        options.text = std::string(version.what()) + "\n";
    } catch (const CLI::ParseError& error) {
        throw UsageError(reason_of(error, arguments));
    }
    if (!options.text.empty()) options.command = Options::Command::text;
    return options;
}

std::vector<CommandText> command_texts() {
    Options options;
    const Grammar grammar(options);
    std::vector<CommandText> texts{command_text(grammar.app)};
    for (const CLI::App* command : grammar.app.get_subcommands({})) {
        if (!command->get_group().empty()) texts.push_back(command_text(*command));
    }
    return texts;
}

std::vector<std::string> split_words(const std::string& text) {
    const boost::escaped_list_separator<char> quoted("", " \t", "\"'");
    std::vector<std::string> words;
    for (const std::string& word : boost::tokenizer<boost::escaped_list_separator<char>>(text, quoted))
        if (!word.empty()) words.push_back(word);
    return words;
}

}  // namespace ptb
