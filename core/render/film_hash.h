#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace ptb {

/// Tells films apart by their bits, as they come from a device: two that are equal have one hash, whatever
/// pieces they were read in. A change of one word always changes it.
class FilmHash {
  public:
    template <class Pixel>
    requires(std::is_trivially_copyable_v<Pixel> &&
             sizeof(Pixel) % sizeof(std::uint64_t) == 0) void add(std::span<const Pixel> pixels) {
        for (const Pixel& pixel : pixels) {
            std::uint64_t words[sizeof(Pixel) / sizeof(std::uint64_t)];
            std::memcpy(words, &pixel, sizeof pixel);
            for (const std::uint64_t word : words) add_word(word);
        }
    }

    /// 16 hexadecimal digits.
    std::string text() const;

  private:
    /// FNV-1a's step, of words, and a shift that brings high bits down; each is one to one.
    void add_word(std::uint64_t word) {
        state_ = (state_ ^ word) * 0x100000001b3u;
        state_ ^= state_ >> 32;
    }

    std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace ptb
