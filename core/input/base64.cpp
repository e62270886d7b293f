#include "core/input/base64.h"

#include <array>

#include "core/input/usage_error.h"

namespace ptb {
namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr unsigned no_digit = 64;

constexpr std::array<unsigned, 256> base64_values_by_digit() {
    std::array<unsigned, 256> values{};
    values.fill(no_digit);
    for (unsigned i = 0; i < base64_digits.size(); ++i)
        values[static_cast<unsigned char>(base64_digits[i])] = i;
    return values;
}
constexpr auto base64_values = base64_values_by_digit();

std::string_view without_padding(std::string_view text) {
    if (text.size() % 4 != 0) throw UsageError("base64: its length is no multiple of 4");
    for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
    return text;
}

}  // namespace

std::string base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::string_view group = bytes.substr(i, 3);
        unsigned bits = 0;
        for (std::size_t j = 0; j < 3; ++j)
            bits = bits << 8 | (j < group.size() ? static_cast<unsigned char>(group[j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += j <= group.size() ? base64_digits[bits >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

std::string from_base64(std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    unsigned bits = 0, count = 0;
    for (const char c : without_padding(text)) {
        const unsigned value = base64_values[static_cast<unsigned char>(c)];
        if (value == no_digit) throw UsageError("base64: a character is none of its 64");
        bits = bits << 6 | value;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xff);
    }
    return bytes;
}

}  // namespace ptb
