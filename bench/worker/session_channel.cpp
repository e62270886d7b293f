#include <utility>

#include "bench/worker/channel.h"
#include "bench/worker/session.h"

namespace ptb {
namespace {

class SessionChannel : public Channel {
  public:
    explicit SessionChannel(std::unique_ptr<WorkerSession> session) : session_(std::move(session)) {}

    Reply request(const Request& request, const Progress& progress, const Stopped&) override {
        Reply reply{Reply::End::crashed, {}, "the session gave no answer", {}};
        PartialReply partial(request, progress);
        session_->answer(request, [&](const Response& response) {
            if (auto last = partial.take(response)) reply = std::move(*last);
        });
        return reply;
    }

  private:
    std::unique_ptr<WorkerSession> session_;
};

}  // namespace

OpenChannel in_process_channels() {
    return [](const DeviceInfo& device) {
        return std::make_unique<SessionChannel>(
            make_session(local_key(device.key), [](std::int64_t) { return false; }));
    };
}

}  // namespace ptb
