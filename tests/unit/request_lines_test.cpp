#include "bench/worker/request_lines.h"

#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/worker/protocol.h"

namespace ptb {
namespace {

/// A pipe whose writing end is closed by hand.
class Pipe {
  public:
    Pipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        in_.open(fmt::format("/dev/fd/{}", ends[0]));
        ::close(ends[0]);
        writing_ = ends[1];
    }
    ~Pipe() { close(); }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    std::istream& in() { return in_; }
    void write(const std::string& text) const {
        EXPECT_EQ(::write(writing_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
    void close() {
        if (writing_ >= 0) ::close(writing_);
        writing_ = -1;
    }

  private:
    std::ifstream in_;
    int writing_ = -1;
};

std::string stop_of(std::int64_t number) {
    Request request;
    request.kind = Request::Kind::stop;
    request.number = number;
    return to_line(request);
}

TEST(RequestLines, come_one_by_one_and_end_with_stdin) {
    Pipe pipe;
    RequestLines lines(pipe.in());
    pipe.write("one\ntwo\n");
    EXPECT_EQ(lines.next(), "one");
    EXPECT_EQ(lines.next(), "two");
    std::thread closing([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        pipe.close();
    });
    EXPECT_EQ(lines.next(), std::nullopt);
    closing.join();
}

TEST(RequestLines, a_stop_overtakes_and_is_for_one_request) {
    Pipe pipe;
    RequestLines lines(pipe.in());
    pipe.write("seven\n");
    EXPECT_EQ(lines.next(), "seven");
    EXPECT_FALSE(lines.is_stopped(7));
    pipe.write(stop_of(7) + "eight\n");
    EXPECT_EQ(lines.next(), "eight");
    EXPECT_TRUE(lines.is_stopped(7));
    EXPECT_FALSE(lines.is_stopped(8));
    EXPECT_FALSE((pipe.close(), lines.next()).has_value());
}

TEST(RequestLines, a_process_that_answers_ends_with_its_stdin) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto hangs_in_an_answer = [] {
        Pipe pipe;
        RequestLines lines(pipe.in());
        pipe.write("one\n");
        lines.next();
        pipe.close();
        std::this_thread::sleep_for(std::chrono::hours(1));
    };
    EXPECT_EXIT(hangs_in_an_answer(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace ptb
