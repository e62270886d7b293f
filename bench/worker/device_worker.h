#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "bench/worker/channel.h"

namespace ptb {

/// A worker of another version of ptbench: its numbers are not comparable. Ends the run with exit code 7.
struct VersionMismatch : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One device's worker: opened on demand, replaced after it died or its device failed, given up when it
/// cannot open a second time.
class DeviceWorker {
  public:
    DeviceWorker(const DeviceInfo& device, const OpenChannel& open, const MeasureOptions& measure)
        : device_(device), open_(open), measure_(measure) {}

    /// True when a worker is there and open. Throws VersionMismatch.
    bool ready();

    /// Why no worker will ever open on this device, or empty.
    const std::string& given_up() const { return given_up_; }

    /// Sends a request to a worker that is ready.
    Reply request(const Request& request, const Channel::Progress& progress);

    void close() { channel_.reset(); }

  private:
    Reply open();
    void judge(const Reply& reply);

    DeviceInfo device_;
    OpenChannel open_;
    MeasureOptions measure_;
    std::unique_ptr<Channel> channel_;
    std::string given_up_;
    int failed_opens_ = 0;
};

}  // namespace ptb
