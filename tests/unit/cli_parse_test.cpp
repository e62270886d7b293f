#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/cli/hints.h"
#include "bench/cli/options.h"
#include "bench/cli/outputs.h"
#include "tests/support/variable.h"

namespace ptb {
namespace {

using Words = std::vector<std::string>;

std::string error_of(const Words& words) {
    try {
        parse_options(words);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "no error";
}

RunFlags run_flags(const Words& words) { return parse_options(words).run; }

TEST(cli_parse, nothing_is_a_run_of_the_quick_config) {
    const Options options = parse_options({});
    EXPECT_EQ(options.command, Options::Command::run);
    EXPECT_EQ(options.run.config, "");
    EXPECT_EQ(configured(options.run, options.common).name, "quick");
    EXPECT_FALSE(options.run.no_isolate);
    EXPECT_FALSE(options.run.samples);
}

TEST(cli_parse, run_may_be_said_or_left_out) {
    EXPECT_TRUE(run_flags({"run", "--all-devices"}).all_devices);
    EXPECT_TRUE(run_flags({"--all-devices"}).all_devices);
}

TEST(cli_parse, commands_are_told_apart) {
    EXPECT_EQ(parse_options({"list", "--json"}).command, Options::Command::list);
    EXPECT_TRUE(parse_options({"list", "--json"}).list.json);
    EXPECT_EQ(parse_options({"-l"}).command, Options::Command::list);
    EXPECT_EQ(parse_options({"worker", "--device", "pocl:0"}).worker.device, "pocl:0");
    EXPECT_TRUE(parse_options({"worker", "--probe"}).worker.probe);
    const RenderFlags render =
        parse_options({"render", "-d", "0", "--spp", "16", "--scene", "thesis", "-o", "x.png"}).render;
    EXPECT_EQ(render.devices, std::vector<std::string>{"0"});
    EXPECT_EQ(render.output, "x.png");
    EXPECT_EQ(render.axis_values.at("spp"), "16");
    EXPECT_FALSE(render.time_s);
    EXPECT_EQ(parse_options({"render", "--time", "2.5", "-o", "x.png"}).render.time_s, 2.5);
}

TEST(cli_parse, lists_are_made_by_repeating_and_keep_brackets) {
    EXPECT_EQ(run_flags({"-d", "cpu", "-d", "/nvidia/", "--device=0:1"}).devices,
              (Words{"cpu", "/nvidia/", "0:1"}));
    EXPECT_EQ(run_flags({"-a", "spp=[10,100]", "-a", "(spp,size)=[(1,2),(3,4)]"}).axes,
              (Words{"spp=[10,100]", "(spp,size)=[(1,2),(3,4)]"}));
}

TEST(cli_parse, sugar_is_kept_as_text_of_its_axis) {
    const auto values =
        run_flags({"--spp", "10,100", "--wg", "[implicit,16x16]", "--path-length=5"}).axis_values;
    EXPECT_EQ(values.at("spp"), "10,100");
    EXPECT_EQ(values.at("work_group"), "[implicit,16x16]");
    EXPECT_EQ(values.at("path_length"), "5");
}

TEST(cli_parse, measuring_flags) {
    const RunFlags flags =
        run_flags({"-w", "2", "--samples", "9", "--max-time", "1.5", "--timeout", "3", "--max-total-time",
                   "60", "--seed", "7", "--timer", "host", "--no-isolate"});
    EXPECT_EQ(flags.warmup, 2);
    EXPECT_EQ(flags.samples, 9);
    EXPECT_EQ(flags.max_time_s, 1.5);
    EXPECT_EQ(flags.timeout_s, 3);
    EXPECT_EQ(flags.max_total_time_s, 60);
    EXPECT_EQ(flags.seed, 7U);
    EXPECT_EQ(flags.timer, "host");
    EXPECT_TRUE(flags.no_isolate);
}

TEST(cli_parse, stdout_is_a_file_name) {
    EXPECT_EQ(run_flags({"--csv", "-"}).csv, "-");
    EXPECT_EQ(run_flags({"--json=-"}).json, "-");
}

TEST(cli_parse, a_typo_gets_the_nearest_flag) {
    EXPECT_EQ(error_of({"--sppp", "10"}), "unknown option --sppp; did you mean --spp?");
    EXPECT_EQ(error_of({"--all-device"}), "unknown option --all-device; did you mean --all-devices?");
    EXPECT_EQ(error_of({"render", "--sead=3"}), "unknown option --sead; did you mean --seed?");
    EXPECT_EQ(error_of({"lst"}),
              "unknown command lst; did you mean list?; commands: run, list, render, compare, ab, tune, "
              "doctor, report");
}

TEST(cli_parse, every_error_is_one_line) {
    for (const Words& words :
         {Words{"--samples", "none"}, Words{"--samples", "0"}, Words{"--max-time", "nan"},
          Words{"--max-time", "inf"}, Words{"--max-time", "0"}, Words{"--warmup", "-1"},
          Words{"--timer", "sun"}, Words{"--color", "blue"}, Words{"--csv"},
          Words{"--kernel-dir", "/no/such/folder"}, Words{"--seed", "-1"}}) {
        const std::string error = error_of(words);
        EXPECT_NE(error, "no error") << words.front() << " " << words.back();
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_NE(error.find(words.front()), std::string::npos) << error;
    }
}

TEST(cli_parse, the_environment_stands_in_for_what_is_not_given) {
    const Variable config("PTBENCH_CONFIG", "thesis"), total("PTBENCH_MAX_TOTAL_TIME", "30"),
        spp("PTBENCH_SPP", "4");
    const RunFlags from_environment = run_flags({});
    const RunFlags given = run_flags({"--config", "ci", "--spp", "8"});
    EXPECT_EQ(from_environment.config, "thesis");
    EXPECT_EQ(from_environment.max_total_time_s, 30);
    EXPECT_EQ(from_environment.axis_values.at("spp"), "4");
    EXPECT_EQ(given.config, "ci");
    EXPECT_EQ(given.axis_values.at("spp"), "8");
}

/// How the words of a command begin; those of a run need none.
Words begun(const CommandText& command) { return command.name == "ptbench" ? Words() : Words{command.name}; }

void expect_empty_refused(Words words, const Words& last, const std::string& flag, const std::string& says) {
    words.insert(words.end(), last.begin(), last.end());
    const std::string error = error_of(words);
    EXPECT_EQ(error.find(flag + ": found \"\"; allowed: "), 0U)
        << words.front() << " " << flag << ": " << error;
    EXPECT_NE(error.find(says), std::string::npos) << error;
}

TEST(cli_parse, an_empty_value_of_any_option_is_refused) {
    int options = 0;
    for (const CommandText& command : command_texts())
        for (const OptionText& option : command.options) {
            if (option.value.empty()) continue;
            const std::string flag = option.flags.empty() ? "files" : option.flags.back();
            expect_empty_refused(begun(command), option.flags.empty() ? Words{""} : Words{flag, ""}, flag,
                                 "");
            if (!option.flags.empty()) expect_empty_refused(begun(command), {flag + "="}, flag, "");
            if (!option.flags.empty())
                expect_empty_refused(begun(command), {flag + "=", "--quiet"}, flag, "");
            ++options;
        }
    EXPECT_GT(options, 80) << "the list of options is not whole";
}

TEST(cli_parse, an_empty_variable_of_any_option_is_refused_unless_the_option_is_given) {
    int variables = 0;
    for (const CommandText& command : command_texts())
        for (const OptionText& option : command.options) {
            if (option.variable.empty()) continue;
            const Variable empty(option.variable.c_str(), "");
            expect_empty_refused(begun(command), {}, option.flags.back(), "(" + option.variable + ")");
            ++variables;
        }
    EXPECT_GT(variables, 40) << "the list of options is not whole";
    const Variable empty("PTBENCH_SAMPLES", "");
    EXPECT_EQ(run_flags({"--samples", "3"}).samples, 3);
    EXPECT_EQ(parse_options({"compare", "a", "b"}).command, Options::Command::compare) << "not its option";
}

TEST(cli_parse, help_and_version_are_text) {
    EXPECT_NE(parse_options({"--help"}).text.find("--all-devices"), std::string::npos);
    EXPECT_NE(parse_options({"render", "--help"}).text.find("--output"), std::string::npos);
    EXPECT_EQ(parse_options({"--version"}).text.substr(0, 8), "ptbench ");
}

TEST(cli_parse, values_may_be_one_a_list_or_a_range) {
    using Points = std::vector<Words>;
    EXPECT_EQ(axis_of_values("spp", "10").points, (Points{{"10"}}));
    EXPECT_EQ(axis_of_values("spp", "10,100").points, (Points{{"10"}, {"100"}}));
    EXPECT_EQ(axis_of_values("spp", "[10,100]").points, (Points{{"10"}, {"100"}}));
    EXPECT_EQ(axis_of_values("spp", "1:4:x2").points, (Points{{"1"}, {"2"}, {"4"}}));
    EXPECT_EQ(axis_of_values("scene", "a\\,b.json,c").points, (Points{{"a,b.json"}, {"c"}}));
    EXPECT_EQ(parse_axis("(scene,spp)=[(a\\,b,2),(c,3)]").points, (Points{{"a,b", "2"}, {"c", "3"}}));
    EXPECT_EQ(axis_of_values("work_group", "implicit,16x16").points, (Points{{"implicit"}, {"16x16"}}));
}

TEST(cli_parse, a_launcher_is_split_into_words) {
    EXPECT_EQ(split_words("srun -w node7"), (Words{"srun", "-w", "node7"}));
    EXPECT_EQ(split_words("sh -c 'a b'"), (Words{"sh", "-c", "a b"}));
    EXPECT_TRUE(split_words("").empty());
}

/// A folder that goes away, as the current one.
struct InScratchFolder : testing::Test {
    std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("ptb-outputs-" + std::to_string(::getpid()));
    InScratchFolder() {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        std::filesystem::current_path(folder);
    }
    ~InScratchFolder() override {
        std::filesystem::current_path(before);
        std::filesystem::remove_all(folder);
    }
};
using outputs = InScratchFolder;

constexpr auto noon = "2016-05-17T12:00:00Z";

TEST_F(outputs, are_refused_before_the_run_and_leave_nothing) {
    RunFlags flags;
    flags.csv = "missing/x.csv";
    EXPECT_THROW(Outputs(flags, "quick", noon), UsageError);
    flags.csv = flags.json = "-";
    EXPECT_THROW(Outputs(flags, "quick", noon), UsageError);
    flags.csv = "x.csv";
    flags.json = "/proc/x.json";
    EXPECT_THROW(Outputs(flags, "quick", noon), UsageError);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(outputs, a_run_that_ends_early_leaves_no_folder) {
    { const Outputs written(RunFlags(), "quick", noon); }
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(outputs, go_into_a_folder_named_after_time_and_config) {
    Outputs written(RunFlags(), "a/b", noon);
    written.write(ResultFile(), PublishedTable());
    EXPECT_EQ(written.written(), (Words{"ptbench-results/2016-05-17T12-00-00Z-a-b/result.json",
                                        "ptbench-results/2016-05-17T12-00-00Z-a-b/result.csv",
                                        "ptbench-results/2016-05-17T12-00-00Z-a-b/table.md"}));
    const Outputs second(RunFlags(), "a/b", noon);
    EXPECT_EQ(second.journal(), "ptbench-results/2016-05-17T12-00-00Z-a-b-2/journal.jsonl");
}

TEST_F(outputs, a_folder_is_held_while_a_run_lasts) {
    RunFlags flags;
    flags.out = "out";
    {
        Outputs first(flags, "quick", noon);
        EXPECT_THROW(Outputs(flags, "quick", noon), UsageError);
        first.write(ResultFile(), PublishedTable());
    }
    EXPECT_NO_THROW(Outputs(flags, "quick", noon));
}

TEST_F(outputs, existing_files_survive_the_check) {
    std::ofstream("x.csv") << "precious";
    RunFlags flags;
    flags.csv = "x.csv";
    const Outputs written(flags, "quick", noon);
    EXPECT_EQ(std::filesystem::file_size("x.csv"), 8U);
}

TEST_F(outputs, a_failing_write_tells_where_the_data_is) {
    RunFlags flags;
    flags.json = "/dev/full";
    Outputs written(flags, "quick", noon);
    try {
        written.write(ResultFile(), PublishedTable());
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("the run's data is in /"), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("journal.jsonl"), std::string::npos) << error.what();
    }
}

Case picture_case(const std::string& kernel, int spp, WorkGroup work_group = {}) {
    Case c = default_case();
    c.device = "pocl@2:0";
    c.kernel = kernel;
    c.spp = spp;
    c.work_group = work_group;
    return c;
}

TEST_F(outputs, the_best_case_of_a_device_makes_its_picture_whatever_the_order) {
    Outputs written(RunFlags(), "quick", noon);
    const std::vector<Case> cases{picture_case("thesis", 100), picture_case("pt", 10),
                                  picture_case("pt", 100), picture_case("pt", 1000, {64, 0}),
                                  picture_case("thesis", 1000)};
    const auto pictures = written.pictures(Pictures::best, cases);
    EXPECT_EQ(pictures.size(), cases.size());
    const auto better = [&](std::size_t a, std::size_t b) {
        return pictures.at(cases[a]).rank > pictures.at(cases[b]).rank;
    };
    EXPECT_TRUE(better(2, 1) && better(1, 3) && better(3, 4) && better(4, 0));
    EXPECT_EQ(std::filesystem::path(pictures.at(cases[2]).path).filename(), "pocl-2-0.png");
}

Record pictured_case(const std::string& kernel, int spp, double ms) {
    Record record;
    record.params = picture_case(kernel, spp);
    record.status = Status::ok;
    record.work.emplace().segments = 1;
    record.statistics.emplace().median_ns = ms * 1e6;
    const Noise noise{0.1, 0.01, 100 / ms, {}, {}};
    record.efficiency = Efficiency{noise, noise, "film", ""};
    return record;
}

TEST_F(outputs, at_equal_time_each_kernel_keeps_one_picture) {
    Outputs written(RunFlags(), "ladder", noon);
    const std::vector<Record> records{pictured_case("thesis", 1, 100), pictured_case("pt", 10, 110),
                                      pictured_case("pt", 20, 220)};
    std::vector<Case> cases{picture_case("pt", 10, {64, 0})};
    for (const Record& record : records) cases.push_back(record.params);
    const auto files = written.pictures(Pictures::equal_time, cases);
    EXPECT_EQ(files.size(), 3U) << "a work-group of its own has none";
    for (const auto& [c, file] : files) std::ofstream(file.path) << "picture";
    const auto pictures = written.made(records);
    written.keep(pictures);
    EXPECT_EQ(pictures.size(), 2U);
    EXPECT_TRUE(std::filesystem::exists(files.at(records[0].params).path));
    EXPECT_TRUE(std::filesystem::exists(files.at(records[1].params).path));
    EXPECT_FALSE(std::filesystem::exists(files.at(records[2].params).path)) << "220 ms are not 100 ms";
}

TEST(hints, name_a_device_that_was_left_out) {
    DeviceInfo cpu, gpu;
    cpu.key = "pocl:0";
    gpu.key = "nvidia:0";
    gpu.name = "NVIDIA H200";
    Config config;
    config.name = "thesis";
    EXPECT_EQ(hints(config, {cpu, gpu}, {cpu}, {}), (Words{"-d nvidia:0 measures NVIDIA H200"}));
    EXPECT_TRUE(hints(config, {cpu, gpu}, {cpu, gpu}, {}).empty());
}

}  // namespace
}  // namespace ptb
