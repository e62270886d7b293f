#include "bench/worker/process.h"

#include <thread>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

namespace ptb {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

ChildCommand shell(const std::string& script) { return {{"/bin/sh", "-c", script}, {}}; }

std::string first_line(WorkerProcess& process) {
    std::string line;
    EXPECT_EQ(process.read_line(line, seconds(10)), ReadStatus::line);
    return line;
}

bool exists(int pid) { return ::kill(pid, 0) == 0; }

bool ends_soon(int pid) {
    for (int i = 0; i < 100 && exists(pid); ++i) std::this_thread::sleep_for(milliseconds(20));
    return !exists(pid);
}

TEST(process, echoes_lines_one_by_one) {
    WorkerProcess cat({{"cat"}, {}});
    ASSERT_TRUE(cat.write_line("one\ntwo\n"));
    EXPECT_EQ(first_line(cat), "one");
    EXPECT_EQ(first_line(cat), "two");
}

TEST(process, a_line_longer_than_a_pipe_arrives_whole) {
    WorkerProcess process(shell("head -c 300000 /dev/zero | tr '\\0' x; echo"));
    EXPECT_EQ(first_line(process).size(), 300000U);
}

TEST(process, silence_is_reported_after_the_timeout) {
    WorkerProcess process(shell("sleep 100"));
    std::string line;
    EXPECT_EQ(process.read_line(line, milliseconds(100)), ReadStatus::silent);
}

TEST(process, a_line_after_silence_is_still_read) {
    WorkerProcess process(shell("read word; echo late"));
    std::string line;
    EXPECT_EQ(process.read_line(line, milliseconds(50)), ReadStatus::silent);
    process.write_line("word\n");
    EXPECT_EQ(first_line(process), "late");
}

TEST(process, a_stop_ends_the_wait) {
    WorkerProcess process(shell("sleep 100"));
    std::string line;
    EXPECT_EQ(process.read_line(line, seconds(60), [] { return true; }), ReadStatus::interrupted);
}

TEST(process, a_signal_is_named) {
    WorkerProcess process(shell("kill -SEGV $$"));
    std::string line;
    EXPECT_EQ(process.read_line(line, seconds(10)), ReadStatus::ended);
    EXPECT_EQ(process.ending(), "killed by SIGSEGV (11)");
}

TEST(process, an_exit_code_is_told) {
    WorkerProcess process(shell("exit 3"));
    std::string line;
    EXPECT_EQ(process.read_line(line, seconds(10)), ReadStatus::ended);
    EXPECT_EQ(process.ending(), "exited with code 3");
}

TEST(process, an_end_is_seen_though_a_grandchild_holds_the_pipes) {
    WorkerProcess process(shell("sleep 100 & exit 4"));
    std::string line;
    EXPECT_EQ(process.read_line(line, seconds(60)), ReadStatus::ended);
    EXPECT_EQ(process.ending(), "exited with code 4");
}

TEST(process, lines_before_the_end_are_read) {
    WorkerProcess process(shell("echo a; echo b; kill -9 $$"));
    siginfo_t how;
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(process.pid()), &how, WEXITED | WNOWAIT), 0);
    EXPECT_EQ(first_line(process), "a");
    EXPECT_EQ(first_line(process), "b");
}

TEST(process, the_tail_of_stderr_is_kept_and_bounded) {
    WorkerProcess process(
        shell("i=0; while [ $i -lt 2000 ]; do echo line $i >&2; i=$((i+1)); done; echo done"));
    first_line(process);
    std::string line;
    EXPECT_EQ(process.read_line(line, seconds(10)), ReadStatus::ended);
    EXPECT_LE(process.stderr_tail().size(), 4096U);
    EXPECT_EQ(last_line(process.stderr_tail()), "line 1999");
}

TEST(process, the_environment_is_extended_and_reduced) {
    ::setenv("PTB_TEST_GONE", "here", 1);
    WorkerProcess process({{"/bin/sh", "-c", "echo $PTB_TEST_SET-$PTB_TEST_GONE-$HOME"},
                           {{"PTB_TEST_SET", "value"}, {"PTB_TEST_GONE", ""}}});
    EXPECT_EQ(first_line(process), std::string("value--") + ::getenv("HOME"));
}

TEST(process, destruction_kills_the_whole_group) {
    int child = 0, grandchild = 0;
    {
        WorkerProcess process(shell("sleep 100 & echo $!; wait"));
        grandchild = std::stoi(first_line(process));
        child = process.pid();
        EXPECT_TRUE(exists(child));
    }
    EXPECT_FALSE(exists(child)) << "a zombie is left";
    EXPECT_TRUE(ends_soon(grandchild));
}

TEST(process, pipes_do_not_leak_into_later_children) {
    const auto descriptors = shell("set -- /proc/$$/fd/*; echo $#");
    WorkerProcess alone(descriptors);
    const std::string expected = first_line(alone);
    const WorkerProcess other(shell("sleep 100"));
    WorkerProcess later(descriptors);
    EXPECT_EQ(first_line(later), expected) << "a worker whose stdin others hold never sees its end";
}

TEST(process, a_missing_executable_is_an_error_that_names_it) {
    try {
        WorkerProcess process({{"no-such-program-here"}, {}});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no-such-program-here"), std::string::npos);
    }
    EXPECT_THROW(WorkerProcess({{"/no/such/program"}, {}}), std::runtime_error);
}

TEST(process, writing_to_a_dead_child_is_not_fatal) {
    WorkerProcess process(shell("exit 0"));
    process.ending();
    EXPECT_FALSE(process.write_line("hello\n"));
}

TEST(process, last_line_ignores_trailing_blanks) {
    EXPECT_EQ(last_line("a\nb \n\n"), "b");
    EXPECT_EQ(last_line("only"), "only");
    EXPECT_EQ(last_line(" \n"), "");
}

}  // namespace
}  // namespace ptb
