#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "core/render/parts.h"

namespace ptb {

/// Ranges that follow each other joined, in order.
std::vector<PartRange> joined(std::vector<PartRange> ranges);

/// More parts, from where others take theirs, too; nothing once there are none.
using MoreParts = std::function<std::optional<PartRange>()>;

/// Hands out the parts of a picture to devices that ask for them, each from a thread of its own. A device
/// keeps the film of what it made until it delivers it; what it made until then is lost with it, and handed
/// out again.
class HandOut {
  public:
    /// To anybody: as many parts as a device makes in 20 ms, or half of what would be its share of all that
    /// is left, up to the ends of rounds.
    /// @param round_parts  parts of a round of samples
    /// @param parts_per_s  of each device, as far as is known
    /// @param more         asked once all is handed out
    HandOut(std::vector<PartRange> open, std::uint64_t round_parts, std::vector<double> parts_per_s,
            MoreParts more = {});
    /// To each device what is its own.
    explicit HandOut(std::vector<std::vector<PartRange>> own);

    /// What this device is to make next; nothing where there is nothing for it now.
    std::optional<PartRange> next(std::size_t device);
    /// It made the first parts of what it was given, up to `end`.
    void made(std::size_t device, std::uint64_t end, double seconds);
    /// Its film has arrived.
    void delivered(std::size_t device);
    /// It is gone, with all that it did not deliver. Another worker of it may ask again.
    void lost(std::size_t device);
    /// Nobody gets more.
    void stop();

    bool has_to_deliver(std::size_t device) const;
    /// Waits for as long as others may lose what they made. True: there is more to do.
    bool wait_for_more(std::size_t device);

    /// What is in the films that were delivered.
    std::vector<PartRange> delivered_by(std::size_t device) const;
    /// Parts that were made and not lost.
    std::uint64_t made_so_far() const;

  private:
    struct Device {
        std::vector<PartRange> own, kept, delivered;
        std::optional<PartRange> given;
        double parts_per_s = 0;
        std::uint64_t last_parts = 0;
    };
    std::uint64_t wanted_by(const Device& device) const;
    PartRange cut_from_open(std::uint64_t wanted);
    bool is_work_left(std::size_t device) const;
    bool may_lose_any() const;

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<PartRange> open_;  ///< for anybody
    std::uint64_t round_parts_ = 1;
    bool is_demand_ = true, is_stopped_ = false;
    MoreParts more_;
    std::vector<Device> devices_;
};

}  // namespace ptb
