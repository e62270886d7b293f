// clang's libFuzzer on the target that PTB_FUZZ_TARGET names. Half of the changes are to values of the JSON,
// which changed bytes seldom leave standing.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

#include "core/input/json.h"
#include "core/input/usage_error.h"
#include "tests/fuzz/targets.h"

namespace {

using ptb::Json;
using Random = std::minstd_rand;

std::size_t below(Random& random, std::size_t end) { return random() % end; }

Json& any_node(Json& json, Random& random) {
    Json* node = &json;
    while (node->is_structured() && !node->empty() && below(random, 5) != 0)
        node = &*std::next(node->begin(), static_cast<std::ptrdiff_t>(below(random, node->size())));
    return *node;
}

/// A copy that is cheap to have many times.
Json any_leaf(Json& json, Random& random) {
    const Json& node = any_node(json, random);
    return ptb::dump_json(node).size() < 1000 ? node : Json(nullptr);
}

Json any_value(Random& random) {
    constexpr auto most = std::numeric_limits<std::uint64_t>::max();
    constexpr auto least = std::numeric_limits<std::int64_t>::min();
    static const Json values = {
        nullptr, true,  0,     -1,     1,       2147483647,    4294967296, most,
        least,   1e308, -1e-9, 5e-324, "",      "=1\n\x1b[1m", "1e9",      Json::array(),
        1e17,    0.5,   "ok",  "host", "event", "\xff",        "pocl:0",   Json::object()};
    return values[below(random, values.size())];
}

void change(Json& json, Random& random) {
    Json& node = any_node(json, random);
    const std::size_t how = below(random, 4);
    if (how == 0 && node.is_structured() && !node.empty())
        node.erase(std::next(node.begin(), static_cast<std::ptrdiff_t>(below(random, node.size()))));
    else if (how == 1 && node.is_array() && node.size() < 100)
        node.insert(node.end(), 1 + below(random, 20), any_leaf(json, random));
    else if (how == 2)
        node = Json(any_node(json, random));
    else
        node = any_value(random);
}

/// Where some document in these bytes begins and ends: all of them, or one line.
std::string_view document_in(std::string_view bytes, Random& random) {
    if (below(random, 2) == 0) return bytes;
    const auto at = below(random, bytes.size());
    const auto begin = bytes.rfind('\n', at) + 1;  // npos + 1 is 0
    return bytes.substr(begin, bytes.find('\n', begin) - begin);
}

std::string changed(std::string_view bytes, Random& random) {
    const auto part = document_in(bytes, random);
    Json json = ptb::parse_json(part, "input");
    for (std::size_t i = 0; i <= below(random, 4); ++i) change(json, random);
    std::string text(bytes);
    return text.replace(static_cast<std::size_t>(part.data() - bytes.data()), part.size(),
                        ptb::dump_json(json));
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    Random random(seed);
    if (size == 0 || below(random, 2) == 0) return LLVMFuzzerMutate(data, size, most);
    try {
        const auto text = changed({reinterpret_cast<const char*>(data), size}, random);
        if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
        std::copy(text.begin(), text.end(), data);
        return text.size();
    } catch (const ptb::UsageError&) {  // no JSON any more
        return LLVMFuzzerMutate(data, size, most);
    }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const auto& target : ptb::fuzz::targets())
        if (target.name == PTB_FUZZ_TARGET) target.feed(bytes);
    return 0;
}
