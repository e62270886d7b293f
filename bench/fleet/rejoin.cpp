#include "bench/fleet/rejoin.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

namespace ptb {
namespace {

constexpr const char* left = "it was measured, and is no longer there";

bool was_measured(const DeviceInfo& device) { return device.excluded.empty() || device.excluded == left; }

bool same_device(const DeviceInfo& a, const DeviceInfo& b) {
    if (!a.uuid.empty() && !b.uuid.empty()) return a.uuid == b.uuid;
    return a.key == b.key && a.name == b.name;
}

/// Which of the devices that are there each earlier one is: the one of its key first, where several could be.
class Places {
  public:
    explicit Places(const std::vector<DeviceInfo>& there) : there_(there) {}

    const DeviceInfo* take(const DeviceInfo& earlier) {
        const DeviceInfo* found = nullptr;
        for (const DeviceInfo& device : there_) {
            const bool is_it =
                device.excluded.empty() && !taken_.contains(device.key) && same_device(earlier, device);
            if (is_it && (found == nullptr || device.key == earlier.key)) found = &device;
        }
        if (found != nullptr) taken_.insert(found->key);
        return found;
    }

    /// A key that no device has, for one that left.
    std::string free_key(const std::string& key) {
        std::string free = key;
        const auto is_used = [&] {
            return taken_.contains(free) ||
                   std::any_of(there_.begin(), there_.end(),
                               [&](const DeviceInfo& device) { return device.key == free; });
        };
        for (int n = 1; is_used(); ++n) free = fmt::format("{}~{}", key, n);
        taken_.insert(free);
        return free;
    }

  private:
    const std::vector<DeviceInfo>& there_;
    std::set<std::string> taken_;
};

/// Each part to the keys that its devices have now.
void share_out(const ResultFile& earlier, const std::map<std::string, std::string>& key_of, Rejoined& parts) {
    std::set<std::string> gone;
    for (const DeviceInfo& device : parts.gone) gone.insert(device.key);
    for (Record record : earlier.cases) {
        const auto key = key_of.find(record.params.device);
        if (key != key_of.end()) record.params.device = key->second;
        (gone.contains(record.params.device) ? parts.of_gone : parts.earlier.cases).push_back(record);
    }
    for (DevicePeaks& peaks : parts.earlier.peaks)
        if (const auto key = key_of.find(peaks.device); key != key_of.end()) peaks.device = key->second;
}

}  // namespace

Rejoined rejoined(const ResultFile& earlier, const std::vector<DeviceInfo>& there,
                  const std::vector<DeviceInfo>& chosen) {
    Rejoined parts{earlier, {}, {}, {}};
    parts.earlier.devices.clear();
    parts.earlier.cases.clear();
    Places places(there);
    std::map<std::string, std::string> key_of;
    std::set<std::string> measured;
    for (DeviceInfo device : earlier.devices) {
        if (!was_measured(device)) continue;
        const std::string before = device.key;
        const DeviceInfo* const now = places.take(device);
        device.key = now != nullptr ? now->key : places.free_key(device.key);
        device.excluded = now != nullptr ? "" : left;
        key_of[before] = device.key;
        (now != nullptr ? parts.earlier.devices : parts.gone).push_back(device);
        measured.insert(device.key);
    }
    for (const DeviceInfo& device : chosen) {
        if (measured.insert(device.key).second)
            parts.earlier.devices.push_back(device);  // no difference: it is new
    }
    for (const DeviceInfo& device : there)
        if (device.excluded.empty() && measured.contains(device.key)) parts.devices.push_back(device);
    share_out(earlier, key_of, parts);
    return parts;
}

}  // namespace ptb
