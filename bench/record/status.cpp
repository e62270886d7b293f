#include "bench/record/status.h"

#include <utility>

namespace ptb {
namespace {

constexpr std::pair<Status, const char*> words[] = {
    {Status::ok, "ok"},           {Status::invalid, "invalid"}, {Status::unsupported, "unsupported"},
    {Status::skipped, "skipped"}, {Status::compile, "compile"}, {Status::runtime, "runtime"},
    {Status::timeout, "timeout"}, {Status::crash, "crash"},     {Status::unstable, "unstable"},
};

}  // namespace

std::string to_string(Status status) {
    for (const auto& [value, word] : words)
        if (value == status) return word;
    return "unknown";
}

std::optional<Status> parse_status(std::string_view text) {
    for (const auto& [value, word] : words)
        if (text == word) return value;
    return std::nullopt;
}

}  // namespace ptb
