#include "bench/report/html/exp_golomb.h"

#include <bit>

namespace ptb {
namespace {

/// Digits of `value` + 2^order beyond the order + 1 that it has at least.
int more_digits(std::uint64_t value, int order) {
    return static_cast<int>(std::bit_width((value >> order) + 1)) - 1;
}

std::uint64_t code_length(const std::vector<std::uint64_t>& values, int order) {
    std::uint64_t length = 0;
    for (const std::uint64_t value : values)
        length += static_cast<std::uint64_t>(2 * more_digits(value, order) + 1 + order);
    return length;
}

}  // namespace

void BitString::append(std::uint64_t value, int count) {
    while (count > 0) {
        if (free_ == 0) {
            bytes_ += '\0';
            free_ = 8;
        }
        --count;
        --free_;
        const std::uint64_t bit = value >> count & 1;
        bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) | bit << free_);
    }
}

void append_exp_golomb(BitString& bits, std::uint64_t value, int order) {
    const int more = more_digits(value, order);
    bits.append(0, more);
    bits.append((value >> order) + 1, more + 1);
    bits.append(value, order);
}

ExpGolomb best_code(const std::vector<std::uint64_t>& values) {
    ExpGolomb best{1, code_length(values, 1)};
    for (int order = 2; order < 64; ++order) {
        const std::uint64_t bits = code_length(values, order);
        if (bits < best.bits) best = {order, bits};
    }
    return best;
}

}  // namespace ptb
