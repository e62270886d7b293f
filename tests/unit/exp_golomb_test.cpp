#include "bench/report/html/exp_golomb.h"

#include <limits>

#include <gtest/gtest.h>

namespace ptb {
namespace {

std::string digits(const std::string& bytes) {
    std::string text;
    for (const char byte : bytes)
        for (int i = 7; i >= 0; --i) text += (byte >> i & 1) != 0 ? '1' : '0';
    return text;
}

TEST(ExpGolomb, codes_are_those_of_the_definition) {
    BitString bits;
    append_exp_golomb(bits, 0, 1);  // 10
    append_exp_golomb(bits, 1, 1);  // 11
    append_exp_golomb(bits, 2, 1);  // 0100
    append_exp_golomb(bits, 7, 1);  // 001001
    append_exp_golomb(bits, 7, 3);  // 1111
    EXPECT_EQ(digits(bits.bytes()), "101101000010011111000000");
}

TEST(ExpGolomb, the_largest_number_has_a_code) {
    BitString bits;
    append_exp_golomb(bits, std::numeric_limits<std::uint64_t>::max(), 1);
    // 2^64 + 1 has 65 digits, 63 more than the two that there are at least.
    EXPECT_EQ(digits(bits.bytes()), std::string(63, '0') + "1" + std::string(63, '0') + "1");
}

TEST(ExpGolomb, the_best_code_is_the_shortest) {
    EXPECT_EQ(best_code({}).bits, 0u);
    EXPECT_EQ(best_code({0, 0, 1, 0}).order, 1);
    EXPECT_EQ(best_code({0, 0, 1, 0}).bits, 8u);
    const ExpGolomb large = best_code({1000, 1001, 1023});
    EXPECT_EQ(large.order, 10);
    EXPECT_EQ(large.bits, 33u);
    BitString bits;
    for (const std::uint64_t value : {1000u, 1001u, 1023u}) append_exp_golomb(bits, value, large.order);
    EXPECT_EQ(bits.bytes().size(), 5u);
}

}  // namespace
}  // namespace ptb
