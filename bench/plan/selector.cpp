#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <regex>

#include <fmt/format.h>

#include "bench/plan/config.h"
#include "core/input/nearest.h"
#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr std::size_t longest_pattern = 256;

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::optional<int> number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = !text.empty() && error == std::errc() && end == text.data() + text.size();
    return whole && value >= 0 ? std::optional(value) : std::nullopt;
}

using Selected = std::vector<bool>;

/// Searched in the key, the name, the vendor and the platform, whatever the case of letters.
Selected select_pattern(const std::string& pattern, const std::vector<DeviceInfo>& devices) {
    if (pattern.size() > longest_pattern)
        throw UsageError(fmt::format("device: the pattern is longer than {} characters", longest_pattern));
    Selected selected;
    try {
        const std::regex regex(pattern, std::regex::ECMAScript | std::regex::icase);
        for (const DeviceInfo& d : devices) {
            const auto found = [&](const std::string& text) {
                return std::regex_search(text.substr(0, 256), regex);
            };
            selected.push_back(found(d.key) || found(d.name) || found(d.vendor) || found(d.platform));
        }
    } catch (const std::regex_error& error) {
        throw UsageError(fmt::format("device: found \"/{}/\", which is no regular expression: {}",
                                     printable(pattern), error.what()));
    }
    return selected;
}

/// "0:1": platform and device index.
bool at_position(const std::string& selector, const DeviceInfo& device) {
    const auto colon = selector.find(':');
    if (colon == std::string::npos) return false;
    return number(selector.substr(0, colon)) == device.platform_index &&
           number(selector.substr(colon + 1)) == device.device_index;
}

Selected select(const std::string& selector, const std::vector<DeviceInfo>& devices) {
    if (selector.size() >= 2 && selector.front() == '/' && selector.back() == '/')
        return select_pattern(selector.substr(1, selector.size() - 2), devices);
    const auto word = lower(selector);
    const auto index = number(selector);
    Selected selected;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& d = devices[i];
        const bool type = word == lower(d.type) && (word == "cpu" || word == "gpu" || word == "accelerator");
        const bool listed = index && static_cast<std::size_t>(*index) == i;
        selected.push_back(word == "all" || type || listed || selector == d.key || at_position(selector, d));
    }
    return selected;
}

std::string device_list(const std::vector<DeviceInfo>& devices) {
    std::string list;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& d = devices[i];
        list +=
            fmt::format("{}{} = {} ({}, {}){}", i == 0 ? "" : ", ", i, printable(d.key), printable(d.type),
                        shortened(printable(d.name), 40), d.excluded.empty() ? "" : " not used");
    }
    return list;
}

/// Why none was left: nothing matches, or what does is excluded.
[[noreturn]] void refuse(const std::string& selector, const Selected& selected,
                         const std::vector<DeviceInfo>& devices) {
    const auto first = std::find(selected.begin(), selected.end(), true);
    if (first != selected.end()) {
        const DeviceInfo& d = devices[static_cast<std::size_t>(first - selected.begin())];
        throw UsageError(fmt::format("device: \"{}\" is {}, which is not used: {}", printable(selector),
                                     printable(d.key), printable(d.excluded)));
    }
    std::vector<std::string> words = {"all", "cpu", "gpu", "accelerator"};
    for (const DeviceInfo& d : devices) words.push_back(d.key);
    const bool well_spelled = std::find(words.begin(), words.end(), lower(selector)) != words.end();
    throw UsageError(fmt::format(
        "device: \"{}\" matches none{}; allowed: all, cpu, gpu, accelerator, /regex/, or one of "
        "{}",
        printable(selector), well_spelled ? "" : did_you_mean(selector, words), device_list(devices)));
}

}  // namespace

std::vector<std::string> device_words(const std::vector<std::string>& selectors) {
    std::vector<std::string> words;
    for (const std::string& selector : selectors) {
        if (selector.starts_with('/')) {
            words.push_back(selector);
            continue;
        }
        for (std::size_t at = 0; at <= selector.size();) {
            const std::size_t comma = std::min(selector.find(',', at), selector.size());
            words.push_back(selector.substr(at, comma - at));
            at = comma + 1;
        }
    }
    return words;
}

std::vector<DeviceInfo> select_devices(const std::vector<std::string>& selectors,
                                       const std::vector<DeviceInfo>& devices) {
    if (devices.empty()) return {};
    const auto words = selectors.empty() ? std::vector<std::string>{"all"} : device_words(selectors);
    Selected chosen(devices.size(), false);
    for (const auto& word : words) {
        const Selected selected = select(word, devices);
        bool any = false;
        for (std::size_t i = 0; i < devices.size(); ++i) {
            const bool usable = selected[i] && devices[i].excluded.empty();
            chosen[i] = chosen[i] || usable;
            any = any || usable;
        }
        if (!any) refuse(word, selected, devices);
    }
    std::vector<DeviceInfo> result;
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (chosen[i]) result.push_back(devices[i]);
    return result;
}

}  // namespace ptb
