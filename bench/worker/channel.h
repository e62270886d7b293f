#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bench/record/record.h"
#include "bench/worker/picture.h"
#include "bench/worker/probe.h"
#include "bench/worker/protocol.h"

namespace ptb {

/// What became of a request: a final answer, or why there is none.
struct Reply {
    enum class End { answered, crashed, timed_out, interrupted, not_started };
    End end = End::answered;
    Response response;             ///< when answered: anything but progress and pixels
    std::string reason;            ///< when not answered: "killed by SIGSEGV (11): last line of stderr"
    std::optional<Image> picture;  ///< when answered, and all of it came
    std::string printed = {};      ///< when answered: the last of what the driver printed meanwhile
};

/// The way to one device's session, wherever it runs. Once a request was not answered, the channel is dead.
class Channel {
  public:
    using Progress = std::function<void(const Response&)>;
    virtual ~Channel() = default;
    /// `enough` is asked while waiting; once it is true, what goes on for as long as nobody ends it is ended.
    virtual Reply request(const Request& request, const Progress& progress, const Stopped& enough) = 0;
    /// Ends what answers. False when it may live on.
    virtual bool end() { return true; }
};

/// Takes in the messages that answer a request.
class PartialReply {
  public:
    PartialReply(const Request& request, const Channel::Progress& progress)
        : picture_(request.params.size), progress_(progress) {}

    /// The reply, if this is the last message of it.
    std::optional<Reply> take(const Response& response);

  private:
    PictureInRows picture_;
    const Channel::Progress& progress_;
};

/// Makes a channel to a device; throws std::runtime_error when nothing can be started.
using OpenChannel = std::function<std::unique_ptr<Channel>(const DeviceInfo&)>;

/// Channels to worker processes that see only the device's driver. One silent for longer than `silence`, or
/// when `stopped` says so, is ended; but a `render` is stopped then, and still answers. Their requests throw
/// TwoWorkers.
OpenChannel process_channels(const WorkerLaunch& launch, std::chrono::milliseconds silence,
                             const Stopped& stopped);

/// Channels to sessions in this process (--no-isolate): no protection from crashes and hangs, and no
/// interruption within a request.
OpenChannel in_process_channels();

}  // namespace ptb
