#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ptb {

/// Bits one after another in bytes, the highest of a byte first; the last byte is filled up with zeros.
class BitString {
  public:
    /// The lowest `count` bits of `value`, the highest of them first.
    void append(std::uint64_t value, int count);
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
    int free_ = 0;  ///< bits of the last byte
};

/// Exponential Golomb code of order k, from 1 to 63: value + 2^k in binary, behind a zero for each digit that
/// it has above k + 1. Small values are short, large ones possible. See Teuhola, "A compression method for
/// clustered bit-vectors", Information Processing Letters 7 (6), 1978.
void append_exp_golomb(BitString& bits, std::uint64_t value, int order);

struct ExpGolomb {
    int order = 1;
    std::uint64_t bits = 0;  ///< of all the values in it
};

/// The shortest code of the values.
ExpGolomb best_code(const std::vector<std::uint64_t>& values);

}  // namespace ptb
