#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/worker/channel.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

using std::chrono::milliseconds;

class ProcessChannel : public Channel {
  public:
    ProcessChannel(const DeviceInfo& device, const WorkerLaunch& launch, milliseconds silence,
                   Stopped stopped)
        : folder_(icd_from_file(device.icd)),
          process_(worker_command(launch, folder_, {"--device", local_key(device.key)})),
          silence_(silence),
          stopped_(std::move(stopped)) {}

    Reply request(const Request& request, const Progress& progress) override {
        if (!process_.write_line(to_line(request))) return crashed();
        for (;;) {
            Reply reply = next_response();
            if (reply.end != Reply::End::answered || reply.response.kind != Response::Kind::progress)
                return reply;
            progress(reply.response);
        }
    }

  private:
    Reply next_response() {
        std::string line;
        switch (process_.read_line(line, silence_, stopped_)) {
            case ReadStatus::line:
                return parsed(line);
            case ReadStatus::ended:
                return crashed();
            case ReadStatus::interrupted:
                process_.kill();
                return {Reply::End::interrupted, {}, "interrupted"};
            case ReadStatus::silent:
                break;
        }
        process_.kill();
        return {Reply::End::timed_out,
                {},
                with_last_words(fmt::format("no sign of life for {:g} s (--timeout)", seconds()))};
    }

    Reply parsed(const std::string& line) {
        try {
            return {Reply::End::answered, parse_response(line), {}};
        } catch (const std::exception&) {
            process_.kill();
            return {Reply::End::crashed,
                    {},
                    fmt::format("the worker answered nonsense: \"{}\"", shortened(printable(line), 60))};
        }
    }

    Reply crashed() { return {Reply::End::crashed, {}, with_last_words(process_.ending())}; }

    std::string with_last_words(const std::string& what) const {
        const std::string words = printable(last_line(process_.stderr_tail()));
        return words.empty() ? what : fmt::format("{}: {}", what, words);
    }

    double seconds() const { return static_cast<double>(silence_.count()) / 1000; }

    IcdFolder folder_;
    WorkerProcess process_;
    milliseconds silence_;
    Stopped stopped_;
};

}  // namespace

OpenChannel process_channels(const WorkerLaunch& launch, milliseconds silence, const Stopped& stopped) {
    return [=](const DeviceInfo& device) {
        return std::make_unique<ProcessChannel>(device, launch, silence, stopped);
    };
}

}  // namespace ptb
