#include "bench/record/host.h"

#include <gtest/gtest.h>

namespace ptb {
namespace {

TEST(host, the_cpu_is_the_first_model_name) {
    EXPECT_EQ(
        cpu_model(
            "processor\t: 0\nmodel\t\t: 79\nmodel name\t: AMD EPYC 7763 64-Core \nmodel name\t: other\n"),
        "AMD EPYC 7763 64-Core");
    EXPECT_EQ(cpu_model("Processor : ARMv7\n"), "");
}

TEST(host, the_os_is_the_pretty_name_without_quotes) {
    EXPECT_EQ(os_name("NAME=\"Debian GNU/Linux\"\nPRETTY_NAME=\"Debian GNU/Linux 12 (bookworm)\"\n"),
              "Debian GNU/Linux 12 (bookworm)");
}

TEST(host, memory_is_in_bytes) {
    EXPECT_EQ(total_memory("MemTotal:       16384 kB\nMemFree: 1 kB\n"), 16384U * 1024);
    EXPECT_EQ(total_memory(""), 0U);
}

TEST(host, a_run_knows_its_tool_and_its_start) {
    const RunInfo info = run_info({"ptbench", "-q"}, "quick", 7);
    EXPECT_EQ(info.argv.size(), 2U);
    EXPECT_EQ(info.seed, 7U);
    EXPECT_FALSE(info.tool_version.empty());
    EXPECT_FALSE(info.compiler.empty());
    EXPECT_EQ(info.started_at.size(), std::string("2016-05-17T09:30:00Z").size());
}

}  // namespace
}  // namespace ptb
