#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "bench/record/record.h"
#include "bench/worker/probe.h"
#include "bench/worker/protocol.h"

namespace ptb {

/// What became of a request: a final answer, or why there is none.
struct Reply {
    enum class End { answered, crashed, timed_out, interrupted };
    End end = End::answered;
    Response response;   ///< when answered: anything but progress
    std::string reason;  ///< when not answered: "killed by SIGSEGV (11): last line of stderr"
};

/// The way to one device's session, wherever it runs. Once a request was not answered, the channel is dead.
class Channel {
  public:
    using Progress = std::function<void(const Response&)>;
    virtual ~Channel() = default;
    virtual Reply request(const Request& request, const Progress& progress) = 0;
};

/// Makes a channel to a device; throws std::runtime_error when nothing can be started.
using OpenChannel = std::function<std::unique_ptr<Channel>(const DeviceInfo&)>;

/// Channels to worker processes that see only the device's driver. One silent for longer than `silence`, or
/// when `stopped` says so, is killed.
OpenChannel process_channels(const WorkerLaunch& launch, std::chrono::milliseconds silence,
                             const Stopped& stopped);

/// Channels to sessions in this process (--no-isolate): no protection from crashes and hangs, and no
/// interruption within a request.
OpenChannel in_process_channels();

}  // namespace ptb
