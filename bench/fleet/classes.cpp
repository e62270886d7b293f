#include "bench/fleet/classes.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "bench/record/cpus.h"

namespace ptb {
namespace {

auto key_of(const DeviceInfo& device) {
    return std::tuple(device.name, device.driver_version, device.platform, device.platform_version,
                      device.compute_units, device.global_bytes);
}

using Facts = std::vector<std::pair<std::string, std::string>>;

template <class Value>
std::string told(const std::optional<Value>& value, const char* unit) {
    return value ? fmt::format("{} {}", *value, unit) : "unknown";
}

Facts facts_of(const Card& card, const HostInfo& host) {
    const DeviceInfo& device = card.device;
    return {{"ECC", device.ecc ? (*device.ecc ? "on" : "off") : "unknown"},
            {"power limit", told(device.power_limit_w, "W")},
            {"highest clock", told(device.max_clock_mhz, "MHz")},
            {"highest memory clock", told(device.max_memory_clock_mhz, "MHz")},
            {"VBIOS", device.vbios},
            {"CPU", host.cpu},
            {"cores", std::to_string(host.cores)},
            {"CPUs allowed", std::to_string(host.cpus_allowed)},
            {"CPU quota", quota_text(host.cpu_quota)},
            {"system", host.os},
            {"kernel", host.kernel}};
}

const HostInfo& host_of(const Fleet& fleet, const Card& card) {
    return std::find_if(fleet.nodes.begin(), fleet.nodes.end(),
                        [&](const FleetNode& node) { return node.name == card.node; })
        ->host;
}

using Groups = std::map<std::string, std::vector<std::size_t>>;

Groups::const_iterator largest(const Groups& groups) {
    return std::max_element(groups.begin(), groups.end(),
                            [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
}

bool has_majority(const Groups& groups) {
    const std::size_t most = largest(groups)->second.size();
    return std::count_if(groups.begin(), groups.end(),
                         [&](const auto& group) { return group.second.size() == most; }) == 1;
}

/// Cards by the hash of their image of a work.
Groups images_of(const Fleet& fleet, const DeviceClass& of, std::size_t work) {
    Groups groups;
    for (const std::size_t card : of.cards)
        for (const CardCase& c : fleet.cards[card].cases)
            if (c.work == work && !c.film_hash.empty()) groups[c.film_hash].push_back(card);
    return groups;
}

}  // namespace

std::vector<DeviceClass> classes_of(const Fleet& fleet) {
    std::map<decltype(key_of(DeviceInfo())), DeviceClass> by_key;
    for (std::size_t i = 0; i < fleet.cards.size(); ++i)
        by_key[key_of(fleet.cards[i].device)].cards.push_back(i);
    std::vector<DeviceClass> classes;
    for (auto& [key, each] : by_key) classes.push_back(std::move(each));
    std::stable_sort(classes.begin(), classes.end(),
                     [](const auto& a, const auto& b) { return a.cards.size() > b.cards.size(); });
    return classes;
}

std::vector<Drift> drift_in(const Fleet& fleet, const DeviceClass& of) {
    std::map<std::string, Groups> values;
    for (const std::size_t i : of.cards)
        for (const auto& [fact, value] : facts_of(fleet.cards[i], host_of(fleet, fleet.cards[i])))
            values[fact][value].push_back(i);
    std::vector<Drift> drifts;
    for (const auto& [fact, groups] : values) {
        const auto most = largest(groups);
        for (auto group = groups.begin(); group != groups.end(); ++group)
            if (group != most) drifts.push_back({fact, most->first, group->first, group->second});
    }
    return drifts;
}

std::vector<WrongBits> wrong_bits(const Fleet& fleet, const DeviceClass& of) {
    std::map<std::size_t, WrongBits> found;
    for (std::size_t work = 0; work < fleet.works.size(); ++work) {
        const Groups groups = images_of(fleet, of, work);
        if (groups.size() < 2) continue;
        const bool in_doubt = !has_majority(groups);
        for (auto group = groups.begin(); group != groups.end(); ++group) {
            if (!in_doubt && group == largest(groups)) continue;
            for (const std::size_t card : group->second) {
                const auto [entry, is_new] = found.try_emplace(card, WrongBits{card, work, in_doubt});
                if (entry->second.in_doubt && !in_doubt) entry->second = {card, work, false};
            }
        }
    }
    std::vector<WrongBits> wrong;
    for (const auto& [card, bits] : found) wrong.push_back(bits);
    return wrong;
}

}  // namespace ptb
