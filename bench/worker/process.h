#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ptb {

/// What to start: `argv`, the first being the executable, and variables set (or, when empty, unset) for it.
struct ChildCommand {
    std::vector<std::string> argv;
    std::map<std::string, std::string> environment;
    std::string nonce{};  ///< a word of `argv` that no other process has, or empty
    bool by_launcher =
        false;  ///< what reads and answers is not the child but what it starts, here or elsewhere
};

/// What came of waiting for a line.
enum class ReadStatus { line, ended, silent, interrupted };

/// Asked while waiting; true ends the wait as `interrupted`.
using Stopped = std::function<bool()>;

/// A child process that reads lines and answers lines. It leads a process group of its own (so a terminal's
/// Ctrl-C does not reach it), which is ended on destruction, and it is told to end when this process dies.
class WorkerProcess {
  public:
    /// Throws std::runtime_error when the executable cannot be started.
    explicit WorkerProcess(const ChildCommand& command);
    ~WorkerProcess();
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    /// Sends `line`, which ends with a newline. False when the child no longer reads.
    bool write_line(const std::string& line);

    /// Waits for the next line, stored in `line` without its newline, for at most `silence`.
    ReadStatus read_line(std::string& line, std::chrono::milliseconds silence, const Stopped& stopped = {});

    /// How the process ended: "killed by SIGSEGV (11)", "exited with code 3". Ends it when it does not.
    std::string ending();

    /// Last lines of the child's stderr since a line was written to it (the first one apart), 4 KB at most.
    std::string stderr_tail() const;

    /// Ends the process and what it started: closes its stdin, then sends SIGTERM and at last SIGKILL to its
    /// group and to whatever has its nonce. False when something of it may live on: its stdout is still held,
    /// or a launcher had to be killed, which then cannot end what it started elsewhere.
    bool end();
    int pid() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Last line of a text that is not blank, or nothing.
std::string last_line(const std::string& text);

/// "SIGSEGV (11)"
std::string signal_name(int signal);

}  // namespace ptb
