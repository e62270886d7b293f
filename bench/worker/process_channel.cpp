#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "bench/worker/channel.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

using std::chrono::milliseconds;

double seconds(milliseconds time) { return static_cast<double>(time.count()) / 1000; }

class ProcessChannel : public Channel {
  public:
    ProcessChannel(const DeviceInfo& device, const WorkerLaunch& launch, milliseconds silence,
                   Stopped stopped)
        : folder_(icd_from_file(device.icd)),
          nonce_(drawn_nonce()),
          process_(worker_command(launch, folder_, nonce_, {"--device", local_key(device.key)})),
          launch_(launch),
          silence_(silence),
          stopped_(std::move(stopped)),
          waiting_(launch.waiting) {}

    Reply request(const Request& request, const Progress& progress, const Stopped& enough) override {
        Request numbered = request;
        numbered.number = ++number_;
        is_stopping_ = false;
        enough_ = enough;
        if (!process_.write_line(to_line(numbered))) return crashed();
        PartialReply partial(request, progress);
        for (;;) {
            Reply reply = next(numbered);
            if (reply.end != Reply::End::answered) return reply;
            if (auto last = partial.take(reply.response)) {
                last->printed = printed();
                return std::move(*last);
            }
        }
    }

    bool end() override { return process_.end(); }

  private:
    Reply next(const Request& request) {
        std::string line;
        ReadStatus status = process_.read_line(line, patience(), [&] { return to_stop(request.kind); });
        if (status == ReadStatus::interrupted && (is_enough() || may_end_early(request.kind))) {
            stop(request);
            status = process_.read_line(line, patience());
        }
        if (status == ReadStatus::line) return checked(line);
        if (status == ReadStatus::ended) return crashed();
        process_.end();
        return status == ReadStatus::interrupted ? Reply{Reply::End::interrupted, {}, "interrupted", {}}
                                                 : silent();
    }

    void stop(Request request) {
        request.kind = Request::Kind::stop;
        process_.write_line(to_line(request));
        is_stopping_ = true;
    }

    /// Asked while waiting. What was rendered of a picture that is stopped is still wanted.
    bool to_stop(Request::Kind kind) {
        if (is_waiting_for_launcher()) waiting_.look(last_words());
        if (kind == Request::Kind::give_film || is_stopping_) return false;
        return is_enough() || (stopped_ && stopped_());
    }

    bool is_enough() const { return enough_ && enough_(); }

    static bool may_end_early(Request::Kind kind) {
        return kind == Request::Kind::render || kind == Request::Kind::render_parts;
    }

    bool is_waiting_for_launcher() const { return !launch_.launcher.empty() && !worker_; }

    milliseconds patience() const { return is_waiting_for_launcher() ? launch_.start_timeout : silence_; }

    Reply silent() const {
        if (is_waiting_for_launcher())
            return {Reply::End::not_started, {}, with_last_words(no_start_text(launch_)), {}};
        return {Reply::End::timed_out,
                {},
                with_last_words(fmt::format("no sign of life for {:g} s (--timeout)", seconds(silence_))),
                {}};
    }

    /// An answer of this worker to this request, and to no other.
    Reply checked(const std::string& line) {
        Response response;
        try {
            response = parse_response(line);
        } catch (const std::exception&) {
            return nonsense(fmt::format("nonsense: \"{}\"", shortened(printable(line), 60)));
        }
        const Reply reply{Reply::End::answered, response, {}, {}};
        if (response.protocol != protocol_version) return reply;  // who else it may be, is not known of it
        if (response.worker.nonce != nonce_) return nonsense("for another run");
        if (!worker_) worker_ = response.worker;
        check_one(*worker_, response.worker);
        if (response.number != number_)
            return nonsense(fmt::format("request {} instead of {}", response.number, number_));
        return reply;
    }

    Reply nonsense(const std::string& what) {
        process_.end();
        return {Reply::End::crashed, {}, "the worker answered " + what, {}};
    }

    Reply crashed() {
        if (is_ended_with_all()) return {Reply::End::interrupted, {}, "interrupted", {}};
        return {Reply::End::crashed, {}, with_last_words(process_.ending()), {}};
    }

    /// A batch system that ends a job tells each of its processes; the worker may hear of it first.
    bool is_ended_with_all() {
        const auto is_to_stop = [&] { return stopped_ && stopped_(); };
        const bool was_told = process_.ending() == "killed by " + signal_name(SIGTERM);
        for (int i = 0; was_told && !is_to_stop() && i < 50; ++i)
            std::this_thread::sleep_for(milliseconds(10));
        return is_to_stop();
    }

    /// What drivers and their compilers printed since the request.
    std::string printed() const {
        const std::string words = process_.stderr_tail();
        return words.substr(0, words.find_last_not_of(" \t\r\n") + 1);  // npos + 1 is 0
    }

    std::string last_words() const { return printable(last_line(process_.stderr_tail())); }

    std::string with_last_words(const std::string& what) const {
        const std::string words = last_words();
        return words.empty() ? what : fmt::format("{}: {}", what, words);
    }

    IcdFolder folder_;
    std::string nonce_;
    WorkerProcess process_;
    WorkerLaunch launch_;
    milliseconds silence_;
    Stopped stopped_;
    Waiting waiting_;
    std::int64_t number_ = 0;
    bool is_stopping_ = false;
    Stopped enough_;
    std::optional<WorkerIdentity> worker_;  ///< once it has answered
};

}  // namespace

std::optional<Reply> PartialReply::take(const Response& response) {
    switch (response.kind) {
        case Response::Kind::progress:
            progress_(response);
            return std::nullopt;
        case Response::Kind::pixels:
            picture_.add(response.first_row, response.rgb);
            return std::nullopt;
        default:
            return Reply{Reply::End::answered, response, {}, picture_.taken()};
    }
}

OpenChannel process_channels(const WorkerLaunch& launch, milliseconds silence, const Stopped& stopped) {
    return [=](const DeviceInfo& device) {
        return std::make_unique<ProcessChannel>(device, launch, silence, stopped);
    };
}

}  // namespace ptb
