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
};

/// What came of waiting for a line.
enum class ReadStatus { line, ended, silent, interrupted };

/// Asked while waiting; true ends the wait as `interrupted`.
using Stopped = std::function<bool()>;

/// A child process that reads lines and answers lines. It leads a process group of its own (so a terminal's
/// Ctrl-C does not reach it), which is killed and reaped on destruction, and it dies when this process does.
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

    /// How the process ended: "killed by SIGSEGV (11)", "exited with code 3". Kills it when it does not end.
    std::string ending();

    /// Last lines of the child's stderr since a line was written to it, 4 KB at most.
    std::string stderr_tail() const;

    void kill();
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
