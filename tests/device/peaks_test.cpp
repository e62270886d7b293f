#include "bench/measure/peaks.h"

#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/ocl/peak_launch.h"
#include "core/source/source.h"
#include "tests/support/devices.h"

namespace ptb {
namespace {

/// One of the devices: kernels are compiled for each.
ocl::Device a_device() { return all_devices().at(0); }

TEST(Peaks, every_one_has_a_value_within_its_interval) {
    std::set<std::string> told, found;
    const auto peaks =
        measure_peaks(a_device(), "auto", "", [&](const std::string& name) { told.insert(name); });
    for (const Peak& peak : peaks) found.insert(peak.name);
    EXPECT_EQ(found, (std::set<std::string>{"fma", "sqrt", "division", "global", "constant", "launch"}));
    EXPECT_EQ(told, found);
    for (const Peak& peak : peaks) {
        SCOPED_TRACE(peak.name);
        EXPECT_GT(peak.value.value_or(0), 0) << peak.reason;
        EXPECT_LE(peak.low.value_or(0), peak.value);
        EXPECT_GE(peak.high.value_or(1e300), peak.value);
    }
}

/// The kernels with one text replaced, in a folder.
struct Changed {
    std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("ptb-peaks-" + std::to_string(::getpid()));
    Changed(const std::string& what, const std::string& by) {
        std::string text = kernel_source("probe/peaks.cl").text;
        EXPECT_NE(text.find(what), text.npos);
        for (auto at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
            text.replace(at, what.size(), by);
        std::filesystem::create_directories(folder / "probe");
        std::ofstream(folder / "probe/peaks.cl") << text;
    }
    ~Changed() { std::filesystem::remove_all(folder); }
};

TEST(Peaks, work_that_was_not_done_is_no_peak) {
    const Changed half("i < steps", "i < steps - steps / 16");
    for (const Peak& peak : measure_peaks(a_device(), "auto", half.folder, [](const std::string&) {})) {
        SCOPED_TRACE(peak.name);
        if (peak.name == "launch") continue;
        EXPECT_THAT(peak.reason, testing::StartsWith("wrong result: "));
        EXPECT_EQ(peak.value, std::nullopt);
    }
}

TEST(LogFacts, nvidias_log_tells_of_the_kernel_that_was_asked_for) {
    const std::string log =
        "ptxas info    : 0 bytes gmem, 64 bytes cmem[3]\n"
        "ptxas info    : Compiling entry function 'pt_add' for 'sm_90'\n"
        "ptxas info    : Function properties for pt_add\n"
        "    0 bytes stack frame, 0 bytes spill stores, 0 bytes spill loads\n"
        "ptxas info    : Used 16 registers, used 0 barriers, 400 bytes cmem[0]\n"
        "ptxas info    : Compiling entry function 'pt_render' for 'sm_90'\n"
        "ptxas info    : Function properties for pt_render\n"
        "    72 bytes stack frame, 24 bytes spill stores, 32 bytes spill loads\n"
        "ptxas info    : Used 128 registers, used 0 barriers, 400 bytes cmem[0]";
    EXPECT_EQ(ocl::log_facts(log, "pt_render"), (ocl::LogFacts{128, 24, 32}));
    EXPECT_EQ(ocl::log_facts(log, "pt_add"), (ocl::LogFacts{16, 0, 0}));
    EXPECT_EQ(ocl::log_facts(log, "pt"), ocl::LogFacts{});
    EXPECT_EQ(ocl::log_facts("", "pt_add"), ocl::LogFacts{});
    EXPECT_EQ(ocl::log_facts("entry function 'k': Used lots of registers", "k"), ocl::LogFacts{});
}

}  // namespace
}  // namespace ptb
