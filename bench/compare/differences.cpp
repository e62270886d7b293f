#include "bench/compare/differences.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/input/printable.h"

namespace ptb {
namespace {

constexpr std::size_t most_shown = 60;

Difference difference(const std::string& field, const std::string& one, const std::string& other,
                      bool may_differ) {
    const auto [a, b] = where_they_differ(one, other, most_shown);
    return {field, fmt::format("{}: \"{}\" and \"{}\"", field, a, b), may_differ};
}

const Fact* fact(const SessionCase& c, const std::string& field) {
    const auto found = std::find_if(c.fingerprint.begin(), c.fingerprint.end(),
                                    [&](const Fact& each) { return each.field == field; });
    return found == c.fingerprint.end() ? nullptr : &*found;
}

std::string scene_text(const SessionCase& c) { return c.params->scene + " " + c.scene_hash; }

}  // namespace

std::vector<Difference> differences(const SessionCase& one, const SessionCase& other) {
    std::vector<Difference> all;
    if (!one.scene_hash.empty() && !other.scene_hash.empty() && one.scene_hash != other.scene_hash)
        all.push_back(difference("scene", scene_text(one), scene_text(other), false));
    for (const Fact& a : one.fingerprint) {
        const Fact* const b = fact(other, a.field);
        if (b == nullptr || a.value == b->value) continue;
        all.push_back(difference(a.field, a.value, b->value, a.may_differ || b->may_differ));
    }
    return all;
}

}  // namespace ptb
