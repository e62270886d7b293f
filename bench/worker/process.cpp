#include "bench/worker/process.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <thread>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <boost/process/args.hpp>
#include <boost/process/async_pipe.hpp>
#include <boost/process/child.hpp>
#include <boost/process/env.hpp>
#include <boost/process/error.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/group.hpp>
#include <boost/process/io.hpp>
#include <boost/process/search_path.hpp>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>

namespace ptb {
namespace {

namespace asio = boost::asio;
namespace process = boost::process;
using Clock = std::chrono::steady_clock;

constexpr std::size_t tail_bytes = 4096;
constexpr std::size_t longest_line = 64U << 20U;
constexpr auto slice = std::chrono::milliseconds(50);
constexpr auto time_to_end = std::chrono::seconds(2);

/// How a process is asked to end, ever less kindly, and how long it then has. A cluster's launcher that is
/// killed leaves its job in the queue and the worker on the node.
struct Farewell {
    int signal;  ///< 0: its stdin is closed
    std::chrono::milliseconds patience;
};
constexpr std::array farewells{Farewell{0, std::chrono::milliseconds(500)},
                               Farewell{SIGTERM, std::chrono::seconds(3)},
                               Farewell{SIGKILL, std::chrono::seconds(2)}};

process::environment child_environment(const ChildCommand& command) {
    process::environment environment = boost::this_process::environment();
    for (const auto& [name, value] : command.environment) {
        if (value.empty()) {
            environment.erase(name);
        } else {
            environment[name] = value;
        }
    }
    return environment;
}

/// Our ends of the pipes must not leak into later children: a worker's stdin would never see its end.
void close_on_exec(const process::async_pipe& pipe) {
    for (const int fd : {pipe.native_source(), pipe.native_sink()}) {
        if (fd >= 0) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
    }
}

std::string describe_status(int status) {
    if (WIFSIGNALED(status)) return "killed by " + signal_name(WTERMSIG(status));
    return fmt::format("exited with code {}", WEXITSTATUS(status));
}

bool has_word(const std::filesystem::path& cmdline, const std::string& word) {
    std::ifstream in(cmdline, std::ios::binary);
    for (std::string each; std::getline(in, each, '\0');)
        if (each == word) return true;
    return false;
}

/// Processes of this machine with this word in their command lines.
std::vector<pid_t> processes_with(const std::string& word) {
    std::vector<pid_t> found;
    std::error_code error;  // it is asked while things end, and may not throw
    for (std::filesystem::directory_iterator entry("/proc", error), last; !error && entry != last;
         entry.increment(error)) {
        const pid_t pid = std::atoi(entry->path().filename().c_str());
        if (pid > 0 && has_word(entry->path() / "cmdline", word)) found.push_back(pid);
    }
    return found;
}

std::string find_executable(const std::string& name) {
    if (name.find('/') != std::string::npos) return name;
    const auto found = process::search_path(name);
    if (found.empty()) throw std::runtime_error(fmt::format("cannot start {}: not found in PATH", name));
    return found.string();
}

}  // namespace

struct WorkerProcess::Impl {
    asio::io_context io;
    process::async_pipe in{io}, out{io}, err{io};
    process::group group;
    process::child child;
    std::string buffer, tail, ending;
    std::array<char, 1024> chunk{};
    std::string nonce;
    bool by_launcher;
    bool has_answered = false;
    bool out_ended = false;
    bool nothing_left = false;  ///< once it has ended

    explicit Impl(const ChildCommand& command) : nonce(command.nonce), by_launcher(command.by_launcher) {
        for (const auto* pipe : {&in, &out, &err}) close_on_exec(*pipe);
        const std::vector<std::string> arguments(command.argv.begin() + 1, command.argv.end());
        const int signal = by_launcher ? SIGTERM : SIGKILL;
        const auto die_with_parent = [signal](auto&) { ::prctl(PR_SET_PDEATHSIG, signal); };
        std::error_code error;
        child = process::child(find_executable(command.argv.front()), process::args(arguments),
                               child_environment(command), process::std_in<in, process::std_out> out,
                               process::std_err > err, group, error,
                               process::extend::on_exec_setup = die_with_parent);
        if (error) {
            throw std::runtime_error(fmt::format("cannot start {}: {}", command.argv[0], error.message()));
        }
        watch_stderr();
    }

    void watch_stderr() {
        err.async_read_some(asio::buffer(chunk), [this](boost::system::error_code error, std::size_t count) {
            if (error) return;
            tail.append(chunk.data(), count);
            if (tail.size() > tail_bytes) tail.erase(0, tail.size() - tail_bytes);
            watch_stderr();
        });
    }

    /// What a child that has answered and lives has said so far is not what it will die of.
    void forget_stderr() {
        if (!has_answered || !running()) return;
        io.restart();
        io.poll();
        tail.clear();
    }

    bool running() {
        std::error_code ignored;
        return ending.empty() && child.running(ignored);
    }

    void send(int signal) {
        const pid_t leader = group.native_handle();
        ::killpg(leader, signal);
        if (nonce.empty()) return;
        for (const pid_t pid : processes_with(nonce))
            if (::getpgid(pid) != leader) ::kill(pid, signal);
    }

    /// Reads away what is still said, until nobody holds the pipe or time is up.
    bool stdout_ends(Clock::time_point until) {
        std::array<char, 1024> away{};
        bool ended = false;
        std::function<void()> read = [&] {
            out.async_read_some(asio::buffer(away), [&](boost::system::error_code error, std::size_t) {
                ended = static_cast<bool>(error);
                if (!ended) read();
            });
        };
        read();
        for (io.restart(); !ended && Clock::now() < until;)
            io.run_one_until(std::min(until, Clock::now() + slice));
        if (ended) return true;
        out.cancel();
        drain();  // runs the cancelled handler, which refers to this frame
        return false;
    }

    /// Whether neither the child nor anybody whom it gave its stdout is left.
    bool is_gone(std::chrono::milliseconds patience) {
        const auto until = Clock::now() + patience;
        if (!out_ended) out_ended = stdout_ends(until);
        while (running() && Clock::now() < until) std::this_thread::sleep_for(slice / 10);
        return out_ended && !running();
    }

    bool end() {
        bool gone = false, killed = false;
        in.close();
        for (const auto& [signal, patience] : farewells) {
            if (signal != 0) send(signal);
            killed = signal == SIGKILL;
            gone = is_gone(patience);
            if (gone) break;
        }
        return gone && !(killed && by_launcher);
    }

    /// Takes in what the child left in its pipes.
    void drain() {
        io.restart();
        const auto until = Clock::now() + slice;
        while (Clock::now() < until && io.run_one_for(slice / 10) > 0) {
        }
    }
};

WorkerProcess::WorkerProcess(const ChildCommand& command) {
    std::signal(SIGPIPE, SIG_IGN);  // a dead worker is seen by its closed pipe, it does not end us
    impl_ = std::make_unique<Impl>(command);
}

WorkerProcess::~WorkerProcess() { end(); }

bool WorkerProcess::write_line(const std::string& line) {
    impl_->forget_stderr();
    boost::system::error_code error;
    asio::write(impl_->in, asio::buffer(line), error);
    return !error;
}

ReadStatus WorkerProcess::read_line(std::string& line, std::chrono::milliseconds silence,
                                    const Stopped& stopped) {
    bool done = false;
    std::size_t length = 0;
    asio::async_read_until(impl_->out, asio::dynamic_buffer(impl_->buffer, longest_line), '\n',
                           [&](boost::system::error_code error, std::size_t count) {
                               done = true;
                               length = error ? 0 : count;
                           });
    const auto give_up = [this](ReadStatus status) {
        impl_->out.cancel();
        impl_->drain();  // runs the cancelled handler, which refers to this frame
        return status;
    };
    const auto deadline = Clock::now() + silence;
    while (!done) {
        impl_->io.restart();
        impl_->io.run_one_for(slice);
        if (done) break;
        if (stopped && stopped()) return give_up(ReadStatus::interrupted);
        if (Clock::now() >= deadline) return give_up(ReadStatus::silent);
        if (!impl_->running()) {  // a grandchild may hold the pipe open, then no end of file ever comes
            impl_->drain();
            if (!done) return give_up(ReadStatus::ended);
        }
    }
    if (length == 0) return ReadStatus::ended;
    impl_->has_answered = true;
    line = impl_->buffer.substr(0, length - 1);
    impl_->buffer.erase(0, length);
    return ReadStatus::line;
}

std::string WorkerProcess::ending() {
    const auto deadline = Clock::now() + time_to_end;
    while (impl_->running() && Clock::now() < deadline) std::this_thread::sleep_for(slice / 10);
    end();
    return impl_->ending;
}

std::string WorkerProcess::stderr_tail() const { return impl_->tail; }

bool WorkerProcess::end() {
    if (!impl_->ending.empty()) return impl_->nothing_left;
    impl_->nothing_left = impl_->end();
    impl_->ending = impl_->running() ? "does not end" : describe_status(impl_->child.native_exit_code());
    impl_->drain();
    return impl_->nothing_left;
}

int WorkerProcess::pid() const { return impl_->child.id(); }

std::string last_line(const std::string& text) {
    const auto end = text.find_last_not_of(" \t\r\n");
    if (end == std::string::npos) return {};
    const auto newline = text.find_last_of('\n', end);
    const auto start = newline == std::string::npos ? 0 : newline + 1;
    return text.substr(start, end + 1 - start);
}

std::string signal_name(int signal) {
    const char* const name = ::sigabbrev_np(signal);
    return name == nullptr ? fmt::format("signal {}", signal) : fmt::format("SIG{} ({})", name, signal);
}

}  // namespace ptb
