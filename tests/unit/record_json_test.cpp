#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <unistd.h>

#include "bench/record/file.h"
#include "bench/record/journal.h"
#include "bench/record/json.h"
#include "bench/record/result_file.h"
#include "bench/record/status.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A folder of its own for each test, gone afterwards.
class RecordJson : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / ("ptb_record_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path file(const std::string& name) const { return folder_ / name; }
    fs::path folder_;
};

Record full_record() {
    Record r;
    r.params = {"pocl:0", "pt", "thesis", {128, 64}, 10, 128, {16, 16}, 8};
    r.params.variant.rng = Rng::park_miller;
    r.status = Status::ok;
    r.work =
        Work{81920, std::numeric_limits<std::uint64_t>::max(), 7, 3, 8, 5, 2, 250'000'000, 1u << 20, 0.25};
    r.build = Build{"-cl-std=CL1.2",    "ab12", true, 1.5, 0.25, 0.125, 12345, 4096, 8, 0, 64,
                    "warning: \"x\"\n", 155625, 128,  0,   {}};
    r.samples = {{100, 101, 102, 3, 4, 5, ""},
                 {std::numeric_limits<std::int64_t>::max(), 1, 2, 3, 4, 0, "timer_fault"}};
    r.statistics = Statistics{"event", "",  2,    1,      100.5,       0.1, 1.0 / 3, 100, 101,
                              100,     101, 99.5, 102.25, "precision", 1.5, 2.5,     3.5};
    r.validation =
        Validation{true, "thesis_pl128", "", 1000, 3.5, 4.75, 0.5, 30.87, 30.9, {"finite", "blocks"}};
    r.energy = Energy{"NVML", "", 2.5, 0.125, 655360, {}};
    r.efficiency =
        Efficiency{Noise{0.25, 0.01, 40.0, 36.5, 44.0}, Noise{0.125, 0.005, {}, {}, {}}, "film", ""};
    r.counted =
        Counted{2'000'000, 233.5, 10.5, 0.0, 1.75, {}, "one lane", {0.25, 0.5, 0.0, 0.001, "roots", 0.5}};
    r.counted->nodes_per_ray = 12.5;
    r.counted->triangles_per_ray = 3.25;
    r.tree = TreeRecord{"wide8", 1000, 1020, 130, 300, 90'000, 7, 21.5, 3.75};
    return r;
}

Record failed_record() {
    Record r;
    r.params = {"nvidia:0", "thesis", "a.json", {1, 1}, 1, 1, {}, 0};
    r.status = Status::unsupported;
    r.reason = "work_group 512, this kernel allows 256 here";
    return r;
}

ResultFile full_result() {
    ResultFile f;
    f.run = {{"ptbench", "--all-devices"},
             "quick",
             "0.1.0",
             "abc",
             "GCC 12",
             "2026-01-01T00:00:00Z",
             "/home/someone",
             true,
             7,
             false,
             2.5,
             {"{\"name\":\"quick\"}"},
             {"2026-01-02T00:00:00Z"},
             {"a.json 12"},
             {failed_record().params}};
    f.host = {"box", "Linux", "6.1", "FX-6300", 6, 4, 1.5, 1u << 30, 0.5};
    DeviceInfo d;
    d.key = "pocl:0";
    d.name = "Some \"CPU\" (R), fast";
    d.type = "CPU";
    d.max_work_item_sizes = {4096, 4096, 4096};
    f.devices = {d};
    f.broken_icds = {{"/etc/bad.icd", "killed by SIGSEGV (11)"}};
    f.warnings = {"one"};
    f.cases = {full_record(), failed_record()};
    f.peaks = {{"pocl:0", "", {{"fma", "GFLOP/s", 117.5, 116, 118, 10, "event", ""}}}};
    f.verdict.json = "{\"schema\":\"ptbench.compare.v1\"}";
    return f;
}

std::string complaint(const fs::path& file) {
    try {
        read_result(file);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "(accepted)";
}

TEST_F(RecordJson, written_result_reads_back_to_the_same_value) {
    write_result(file("r.json"), full_result());
    EXPECT_EQ(read_result(file("r.json")), full_result());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "a temporary file was left behind";
}

TEST_F(RecordJson, case_is_written_in_the_words_of_the_axes) {
    EXPECT_EQ(
        Json(failed_record().params).dump(),
        R"({"device":"nvidia:0","kernel":"thesis","scene":"a.json","size":"1x1","spp":1,"path_length":1,)"
        R"("scene_memory":"auto","film_memory":"buffer","queue":"in_order","dispatch":"ndrange",)"
        R"("pixel_filter":"jitter","rng":"auto","roulette":"off","build":"default","bvh":"auto","bvh_split":"spatial","ray_kind":"primary",)"
        R"("reconstruction":"weighted","lanes":"auto","work_group":"implicit","devices":"1","together":"no"})");
}

TEST_F(RecordJson, case_of_an_earlier_version_has_the_usual_variant) {
    Json json = failed_record().params;
    for (const VariantAxis& axis : variant_axes()) json.erase(axis.name);
    json.erase("devices");
    json.erase("together");
    EXPECT_EQ(json.get<Case>(), failed_record().params);
}

TEST_F(RecordJson, absent_parts_are_null_and_nanoseconds_are_integers) {
    EXPECT_TRUE(Json(failed_record()).at("statistics").is_null());
    EXPECT_EQ(Json(full_record()).at("samples")[1].at("kernel_ns").dump(), "9223372036854775807");
}

TEST_F(RecordJson, numbers_that_are_not_finite_are_written_as_null) {
    Record r = full_record();
    r.statistics->median_ns = std::numeric_limits<double>::quiet_NaN();
    r.statistics->ci_low_ns = std::numeric_limits<double>::infinity();
    const Json json = r;
    EXPECT_TRUE(json.at("statistics").at("median_ns").is_null());
    EXPECT_TRUE(json.at("statistics").at("ci_low_ns").is_null());
    EXPECT_TRUE(std::isnan(json.get<Record>().statistics->median_ns));
}

TEST_F(RecordJson, every_status_has_a_word) {
    for (int i = 0; i <= static_cast<int>(Status::unstable); ++i) {
        const auto status = static_cast<Status>(i);
        EXPECT_EQ(parse_status(to_string(status)), status);
    }
    EXPECT_EQ(parse_status("fine"), std::nullopt);
}

TEST_F(RecordJson, strings_that_are_not_utf8_are_replaced) {
    ResultFile f = full_result();
    f.devices[0].name = "GPU\xff\xfe";
    write_result(file("r.json"), f);
    EXPECT_THAT(read_result(file("r.json")).devices[0].name, StartsWith("GPU\xEF\xBF\xBD"));
}

TEST_F(RecordJson, unknown_fields_are_ignored) {
    Json json = result_to_json(full_result());
    json["future"] = "fine";
    json["cases"][0]["statistics"]["energy_j"] = 1;
    EXPECT_EQ(result_from_json(json, "x"), full_result());
}

TEST_F(RecordJson, newer_and_foreign_files_are_refused) {
    Json json = result_to_json(full_result());
    json["schema"] = "ptbench.v2";
    write_file(file("r.json"), dump_json(json));
    EXPECT_THAT(complaint(file("r.json")),
                AllOf(HasSubstr("r.json: schema ptbench.v2"), HasSubstr("ptbench.v1")));
    for (const char* text :
         {"{}", "[]", "3", R"({"schema": 1})", R"({"schema": "other"})", R"({"context": {}})"}) {
        write_file(file("r.json"), text);
        EXPECT_THAT(complaint(file("r.json")), HasSubstr("not a result of ptbench")) << text;
    }
}

TEST_F(RecordJson, wrong_types_have_a_pointer) {
    const auto with = [&](const char* pointer, const Json& value) {
        Json json = result_to_json(full_result());
        json[Json::json_pointer(pointer)] = value;
        write_file(file("r.json"), dump_json(json));
        return complaint(file("r.json"));
    };
    EXPECT_THAT(with("/cases/0/work/samples", "many"),
                HasSubstr("r.json: /cases/0/work/samples: found \"many\""));
    EXPECT_THAT(with("/cases/0/work/samples", -1), HasSubstr("/cases/0/work/samples: found -1"));
    EXPECT_THAT(with("/cases/0/samples/0/host_ns", 1.5), HasSubstr("/samples/0/host_ns: found 1.5"));
    EXPECT_THAT(with("/cases/0/statistics/n", 99999999999), HasSubstr("/statistics/n: found"));
    EXPECT_THAT(with("/cases/1/status", "fine"), HasSubstr("/cases/1/status: found \"fine\"; allowed: ok"));
    EXPECT_THAT(with("/cases/1/params/size", "0x0"), HasSubstr("/cases/1/params/size: size: found \"0x0\""));
    EXPECT_THAT(with("/cases/1/params/spp", "10"), HasSubstr("/cases/1/params/spp"));
    EXPECT_THAT(with("/cases/1/params", Json::object()), HasSubstr("\"device\" is missing"));
    EXPECT_THAT(with("/cases", 1), HasSubstr("/cases: found 1; allowed: a list"));
    EXPECT_THAT(with("/devices/0", nullptr), HasSubstr("/devices/0"));
    EXPECT_THAT(with("/cases/0/validation/valid", 1), HasSubstr("true or false"));
}

TEST_F(RecordJson, every_truncation_is_refused_in_one_line) {
    const std::string whole = result_text(full_result());
    for (std::size_t length = 0; length + 2 < whole.size(); length += 7) {
        write_file(file("r.json"), whole.substr(0, length));
        const auto message = complaint(file("r.json"));
        EXPECT_THAT(message, HasSubstr("r.json: ")) << length;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

TEST_F(RecordJson, unreadable_files_say_why) {
    EXPECT_THAT(complaint(file("nothing.json")), HasSubstr("No such file"));
    EXPECT_THAT(complaint(folder_), HasSubstr("it is a folder"));
}

TEST_F(RecordJson, files_too_large_to_read_are_refused_unread) {
    std::ofstream(file("huge.json")) << "{";
    fs::resize_file(file("huge.json"), std::uintmax_t{1} << 30);  // takes no room on the disk
    EXPECT_THAT(complaint(file("huge.json")), HasSubstr("huge.json: it is larger than 256 MiB"));
    EXPECT_THAT(complaint("/dev/zero"), HasSubstr("larger than 256 MiB")) << "it has no size";
}

TEST_F(RecordJson, writing_where_one_cannot_says_where_and_why) {
    try {
        write_result(file("no/such/folder/r.json"), full_result());
        FAIL() << "written into a folder that does not exist";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(),
                    AllOf(HasSubstr("no/such/folder/r.json"), HasSubstr("No such file or directory")));
    }
}

TEST_F(RecordJson, a_full_disk_is_found) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    try {
        write_result("/dev/full", full_result());
        FAIL() << "a full disk was not noticed";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("No space left on device"));
    }
    EXPECT_TRUE(fs::is_character_file("/dev/full")) << "a device was replaced by a file";
}

TEST_F(RecordJson, journal_holds_header_and_records) {
    ResultFile header = full_result();
    header.cases = {full_record()};
    Journal journal(file("j.jsonl"), header);
    journal.append(failed_record());
    EXPECT_EQ(read_run(file("j.jsonl")), full_result()) << "a record is not on disk once it was appended";
}

TEST_F(RecordJson, journal_cut_anywhere_keeps_its_whole_lines) {
    Journal(file("j.jsonl"), full_result());
    const std::string whole = read_text(file("j.jsonl"));
    const auto header = whole.find('\n') + 1, first = whole.find('\n', header) + 1;
    for (std::size_t length = header; length < whole.size(); length += 5) {
        write_file(file("cut.jsonl"), whole.substr(0, length));
        const std::size_t kept = length < first - 1 ? 0 : length < whole.size() - 1 ? 1 : 2;
        EXPECT_EQ(read_run(file("cut.jsonl")).cases.size(), kept) << length;
    }
}

TEST_F(RecordJson, a_journal_is_told_from_a_result) {
    EXPECT_FALSE(is_journal(result_text(full_result())));
    EXPECT_FALSE(is_journal(dump_json(result_to_json(full_result())) + "\n")) << "one line";
    EXPECT_FALSE(is_journal(""));
    EXPECT_TRUE(is_journal("{}\n{\"cut"));
}

TEST_F(RecordJson, journal_damaged_in_the_middle_names_the_line) {
    Journal(file("j.jsonl"), full_result());
    std::string text = read_text(file("j.jsonl"));
    text.insert(text.find('\n') + 1, "garbage\n");
    write_file(file("j.jsonl"), text);
    try {
        read_run(file("j.jsonl"));
        FAIL() << "garbage was read";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), HasSubstr("j.jsonl:2: not JSON"));
    }
}

TEST(Printable, control_characters_and_bad_bytes_are_replaced) {
    EXPECT_EQ(printable("a\x1b[31mb\x07"), "a?[31mb?");
    EXPECT_EQ(printable("a\r\n\tb"), "a   b");
    EXPECT_EQ(printable("caf\xC3\xA9 \xE2\x82\xAC"), "caf\xC3\xA9 \xE2\x82\xAC");
    EXPECT_EQ(printable("\xff\xC3"), "??");
    EXPECT_EQ(printable("\xC2\x9B"
                        "31m"),
              "?31m")
        << "an 8-bit control sequence";
    EXPECT_EQ(printable("\xE2\x80\xAE"), "?") << "right-to-left override";
    EXPECT_EQ(printable("\xED\xA0\x80"), "???") << "a surrogate";
    EXPECT_EQ(printable(std::string("\0", 1)), "?");
}

TEST(Printable, text_is_shortened_between_characters) {
    EXPECT_EQ(shortened("NVIDIA H200", 36), "NVIDIA H200");
    EXPECT_EQ(shortened("abcdefgh", 6), "abc...");
    EXPECT_EQ(shortened("\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9\xC3\xA9", 4), "\xC3\xA9...");
    EXPECT_EQ(width("\xC3\xA9x"), 2u);
}

}  // namespace
}  // namespace ptb
