#include "core/input/printable.h"

#include <algorithm>
#include <cstdint>

namespace ptb {
namespace {

/// Bytes of the sequence that starts with `lead`, or 0.
std::size_t sequence_length(unsigned char lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead <= 0xDF) return 2;
    if (lead >= 0xE0 && lead <= 0xEF) return 3;
    if (lead >= 0xF0 && lead <= 0xF4) return 4;
    return 0;
}

/// The code point whose sequence is exactly `bytes`, or 0 (which is not printable either).
std::uint32_t code_point(std::string_view bytes) {
    if (bytes.size() == 1) return static_cast<unsigned char>(bytes[0]);
    std::uint32_t code = static_cast<unsigned char>(bytes[0]) & (0x7Fu >> bytes.size());
    for (const char c : bytes.substr(1)) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0) != 0x80) return 0;
        code = code << 6 | (byte & 0x3Fu);
    }
    const std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    return code < least[bytes.size()] || code > 0x10FFFF || surrogate ? 0 : code;
}

bool is_printable(std::uint32_t code) {
    if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return false;
    const bool separator = code == 0x2028 || code == 0x2029;
    const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) ||
                       code == 0x200E || code == 0x200F || code == 0x061C;
    return !separator && !turns;
}

/// Bytes that both texts begin with, up to the beginning of the word, or of the item of a list, in which they
/// part.
std::size_t common_words(std::string_view one, std::string_view other) {
    const auto parted = std::mismatch(one.begin(), one.end(), other.begin(), other.end()).first;
    const auto same = one.substr(0, static_cast<std::size_t>(parted - one.begin()));
    const auto split = same.find_last_of(" ,[{");
    return split == std::string_view::npos ? 0 : split + 1;
}

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

std::string printable(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto length = sequence_length(static_cast<unsigned char>(text[i]));
        const auto bytes = text.substr(i, length);
        const auto code = length == 0 || bytes.size() < length ? 0 : code_point(bytes);
        if (code == '\n' || code == '\r' || code == '\t')
            result += ' ';
        else if (is_printable(code))
            result += bytes;
        else
            result += '?';
        i += code == 0 ? 1 : length;
    }
    return result;
}

std::size_t width(std::string_view utf8) {
    std::size_t count = 0;
    for (const char c : utf8) count += continues(c) ? 0 : 1;
    return count;
}

std::size_t first_bytes(std::string_view utf8, std::size_t most) {
    std::size_t end = 0;
    for (std::size_t kept = 0; end < utf8.size(); ++end)
        if (!continues(utf8[end]) && kept++ == most) break;
    return end;
}

std::string shortened(std::string_view utf8, std::size_t most) {
    if (width(utf8) <= most) return std::string(utf8);
    std::size_t end = first_bytes(utf8, most - 3);
    while (end > 0 && utf8[end - 1] == ' ') --end;
    return std::string(utf8.substr(0, end)) + "...";
}

std::pair<std::string, std::string> where_they_differ(std::string_view one, std::string_view other,
                                                      std::size_t most) {
    const std::string a = printable(one), b = printable(other);
    const bool whole = width(a) <= most && width(b) <= most;
    const std::size_t same = whole ? 0 : common_words(a, b);
    const auto shown = [&](const std::string& text) {
        return shortened((same == 0 ? "" : "... ") + text.substr(same), most);
    };
    return {shown(a), shown(b)};
}

}  // namespace ptb
