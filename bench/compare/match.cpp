#include "bench/compare/match.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "bench/compare/row.h"

namespace ptb {
namespace {

/// A device as a session knows it.
struct KnownDevice {
    std::string key, name, uuid;
};

std::vector<KnownDevice> devices_of(const Session& session) {
    std::vector<KnownDevice> devices;
    std::set<std::string> seen;
    for (const SessionCase& c : session.cases)
        if (seen.insert(c.device).second) devices.push_back({c.device, c.device_name, c.device_uuid});
    return devices;
}

bool one_device(const std::vector<Session>& sessions) {
    std::set<std::string> devices;
    for (const Session& session : sessions)
        for (const KnownDevice& device : devices_of(session)) devices.insert(device.key);
    return devices.size() == 1;
}

bool same_uuid(const KnownDevice& a, const KnownDevice& b) { return !a.uuid.empty() && a.uuid == b.uuid; }
bool same_key_and_name(const KnownDevice& a, const KnownDevice& b) {
    return a.key == b.key && a.name == b.name;
}
bool same_name(const KnownDevice& a, const KnownDevice& b) { return !a.name.empty() && a.name == b.name; }
bool same_key(const KnownDevice& a, const KnownDevice& b) { return a.key == b.key; }
bool any(const KnownDevice&, const KnownDevice&) { return true; }

/// Numbers the devices of all sessions, so that the same device has the same number.
class Devices {
  public:
    explicit Devices(bool any_device) : any_device_(any_device) {}

    /// Of each device key of the session.
    std::map<std::string, std::size_t> numbers(const Session& session) {
        std::map<std::string, std::size_t> numbers;
        auto left = devices_of(session);
        std::vector<bool> taken(known_.size());
        for (const auto rule : {same_uuid, same_key_and_name, same_name, same_key})
            place(left, taken, rule, numbers);
        if (any_device_) place(left, taken, any, numbers);
        for (const KnownDevice& device : left) {
            numbers[device.key] = known_.size();
            known_.push_back(device);
        }
        return numbers;
    }

  private:
    using Rule = bool (*)(const KnownDevice&, const KnownDevice&);

    /// Gives those numbers for which the rule leaves no choice, on either side.
    void place(std::vector<KnownDevice>& left, std::vector<bool>& taken, Rule rule,
               std::map<std::string, std::size_t>& numbers) const {
        std::map<std::string, std::size_t> found;
        for (std::size_t i = 0; i < known_.size(); ++i) {
            const auto fits = [&](const KnownDevice& device) { return rule(known_[i], device); };
            if (taken[i] || std::count_if(left.begin(), left.end(), fits) != 1) continue;
            const KnownDevice& device = *std::find_if(left.begin(), left.end(), fits);
            if (choices(device, taken, rule) == 1) found[device.key] = i;
        }
        for (const auto& [key, i] : found) taken[i] = true;
        std::erase_if(left, [&](const KnownDevice& device) { return found.contains(device.key); });
        numbers.merge(found);
    }

    std::size_t choices(const KnownDevice& device, const std::vector<bool>& taken, Rule rule) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < known_.size(); ++i)
            if (!taken[i] && rule(known_[i], device)) ++count;
        return count;
    }

    bool any_device_;
    std::vector<KnownDevice> known_;
};

/// Names the scenes of all sessions, so that the same text has the same name: the first that it had.
class Scenes {
  public:
    /// Of each name in the session; those whose text nobody knows are left out.
    std::map<std::string, std::string> names(const Session& session) {
        std::map<std::string, std::set<std::string>> names_of;  // by hash
        for (const SessionCase& c : session.cases)
            if (c.params && !c.scene_hash.empty()) names_of[c.scene_hash].insert(c.params->scene);
        std::map<std::string, std::string> names;
        for (const auto& [hash, scenes] : names_of)
            if (scenes.size() == 1) names[*scenes.begin()] = name_of(hash, *scenes.begin(), names_of);
        return names;
    }

  private:
    /// A text that is new takes its name over from one that is gone: a file that was edited. Where that one
    /// is still there, by another name, they are two scenes.
    template <class NamesOf>
    std::string name_of(const std::string& hash, const std::string& scene, const NamesOf& here) {
        const auto known = name_.find(hash);
        if (known != name_.end()) return known->second;
        const auto& owner = owner_.try_emplace(scene, hash).first->second;
        const bool both_here = owner != hash && here.contains(owner);
        return name_[hash] = both_here ? scene + " " + hash : scene;
    }

    std::map<std::string, std::string> name_;   ///< of a hash
    std::map<std::string, std::string> owner_;  ///< of a name: the hash that had it first
};

/// A case's name with that of its scene among all sessions.
std::string name_among_all(const SessionCase& c, const std::map<std::string, std::string>& scenes) {
    if (!c.params || !scenes.contains(c.params->scene)) return c.name;
    Case named = *c.params;
    named.scene = scenes.at(named.scene);
    return case_text(named);
}

void add(const SessionCase& c, bool is_base, Matched& m) {
    if (m.like == nullptr) m.like = &c;
    if (c.no_time.empty()) (is_base ? m.base : m.now).push_back(&c);
    if (!c.no_time.empty() && !is_base) m.why_not = c.no_time;
}

}  // namespace

std::vector<Matched> match(const std::vector<Session>& base, const std::vector<Session>& now, bool cross) {
    Devices devices(cross && one_device(base) && one_device(now));
    Scenes scenes;
    std::vector<Matched> all;
    std::map<std::pair<std::size_t, std::string>, std::size_t> place;
    for (const auto* const side : {&base, &now})
        for (const Session& session : *side) {
            const auto numbers = devices.numbers(session);
            const auto names = scenes.names(session);
            for (const SessionCase& c : session.cases) {
                const auto [found, is_new] =
                    place.try_emplace({numbers.at(c.device), name_among_all(c, names)}, all.size());
                add(c, side == &base, is_new ? all.emplace_back() : all[found->second]);
            }
        }
    return all;
}

}  // namespace ptb
