#include <iostream>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/worker/devices.h"
#include "bench/worker/probe.h"
#include "bench/worker/request_lines.h"
#include "bench/worker/session.h"

namespace ptb {
namespace {

/// The coordinator's end of stdout. Drivers and their compilers print what they like to stdout; it goes to
/// stderr, so that it cannot be taken for an answer.
class Answers {
  public:
    Answers() : out_(::fdopen(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3), "w")) {
        if (!out_ || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
            throw std::runtime_error("cannot redirect stdout");
    }
    void send(const std::string& line) const {
        std::fputs(line.c_str(), out_.get());
        std::fflush(out_.get());
    }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> out_;
};

int answer_probe(const Answers& answers, const WorkerIdentity& worker) {
    const RequestLines leaves_with_its_coordinator(std::cin);
    answers.send(started_line(worker));
    try {
        answers.send(probe_line(probe_devices()));
    } catch (const std::exception& error) {
        answers.send(probe_error_line(error.what()));
    }
    std::_Exit(exit_codes::done);  // that thread may wait for ever
}

Response failed(const std::string& reason) {
    Response response;
    response.kind = Response::Kind::failed;
    response.reason = reason;
    return response;
}

/// Answers requests one by one, each answer with the request's number and the worker's identity.
class Worker {
  public:
    Worker(const std::string& device, WorkerIdentity identity)
        : identity_(std::move(identity)),
          lines_(std::cin),
          session_(make_session(device, [this](std::int64_t n) { return lines_.is_stopped(n); })) {}

    void answer_all(const Answers& answers) {
        while (const auto line = lines_.next()) {
            std::int64_t number = 0;
            const auto send = [&](Response response) {
                response.number = number;
                response.worker = identity_;
                answers.send(to_line(response));
            };
            try {
                const Request request = parse_request(*line);
                number = request.number;
                session_->answer(request, send);
            } catch (const std::exception& error) {
                send(failed(error.what()));
            }
        }
    }

  private:
    WorkerIdentity identity_;
    RequestLines lines_;
    std::unique_ptr<WorkerSession> session_;
};

}  // namespace

int worker_command_line(const Options& options) {
    const Answers answers;
    const WorkerIdentity identity = this_worker(options.worker.nonce);
    if (options.worker.probe) return answer_probe(answers, identity);
    Worker(options.worker.device, identity).answer_all(answers);
    return exit_codes::done;
}

}  // namespace ptb
