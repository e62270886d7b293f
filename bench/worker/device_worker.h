#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "bench/worker/channel.h"

namespace ptb {

/// A worker of another version of ptbench, or with other kernels: its numbers are not comparable. Ends the
/// run with exit code 7.
struct VersionMismatch : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One device's worker: opened on demand, replaced after it died or its device failed, given up when it
/// cannot open a second time, or when the one before may live on and disturb it.
class DeviceWorker {
  public:
    /// A worker must be of `facts`; without them, all must be of what the first one is of.
    DeviceWorker(const DeviceInfo& device, const OpenChannel& open, const MeasureOptions& measure,
                 std::optional<WorkerFacts> facts)
        : device_(device),
          open_(open),
          measure_(measure),
          is_as_here_(facts.has_value()),
          facts_(std::move(facts)) {}
    DeviceWorker(const DeviceInfo& device, const OpenChannel& open, const MeasureOptions& measure)
        : DeviceWorker(device, open, measure, facts_here(measure.kernel_dir)) {}

    /// True when a worker is there and open. Throws VersionMismatch.
    bool ready();

    /// Why no worker will ever open on this device, or empty.
    const std::string& given_up() const { return given_up_; }

    /// Sends a request to a worker that is ready.
    Reply request(const Request& request, const Channel::Progress& progress, const Stopped& enough = {});

    void close();

  private:
    Reply open();
    void check_facts(const Response& ready);
    void judge(const Reply& reply);
    void keep_printed(const std::string& kernel, Reply& reply);

    DeviceInfo device_;
    OpenChannel open_;
    MeasureOptions measure_;
    bool is_as_here_;  ///< also the texts of scenes must be
    std::optional<WorkerFacts> facts_;
    std::unique_ptr<Channel> channel_;
    std::string given_up_;
    int failed_opens_ = 0;
    std::map<std::string, std::string> printed_;  ///< by kernel: what is to go beside its next build's log
};

}  // namespace ptb
