#include <iostream>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/version.h"
#include "bench/worker/devices.h"
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

int answer_probe(const Answers& answers) {
    try {
        answers.send(probe_line(probe_devices()));
    } catch (const std::exception& error) {
        answers.send(probe_error_line(error.what()));
    }
    return exit_codes::done;
}

Response failed(const std::string& reason) {
    Response response;
    response.kind = Response::Kind::failed;
    response.reason = reason;
    return response;
}

void send_response(const Answers& answers, Response response) {
    if (response.kind == Response::Kind::ready) response.tool_version = version::tool;
    answers.send(to_line(response));
}

}  // namespace

int worker_command_line(const Options& options) {
    const Answers answers;
    if (options.worker.probe) return answer_probe(answers);
    std::unique_ptr<WorkerSession> session;
    for (std::string line; std::getline(std::cin, line);) {
        try {
            const Request request = parse_request(line);
            if (!session) session = make_session(options.worker.device);
            session->answer(request, [&](const Response& response) { send_response(answers, response); });
        } catch (const std::exception& error) {
            send_response(answers, failed(error.what()));
        }
    }
    return exit_codes::done;
}

}  // namespace ptb
