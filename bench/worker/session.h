#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "bench/worker/protocol.h"

namespace ptb {

/// Answers requests for one device: the only part of `bench` that calls OpenCL (through `core`). Runs inside
/// a worker process, or inside the coordinator under --no-isolate.
class WorkerSession {
  public:
    using Send = std::function<void(const Response&)>;
    virtual ~WorkerSession() = default;
    /// Answers one request through `send`; never throws.
    virtual void answer(const Request& request, const Send& send) = 0;
};

/// Whether the request of this number shall end early.
using StopAsked = std::function<bool(std::int64_t number)>;

/// A session on the device with this key, among the ICDs that this process sees.
std::unique_ptr<WorkerSession> make_session(const std::string& device_key, StopAsked stop_asked);

}  // namespace ptb
