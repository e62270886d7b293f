#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <span>

#include "core/render/film_sums.h"

namespace ptb {

/// The sum of films that come from several threads at once.
class FilmTotal {
  public:
    explicit FilmTotal(Size size);

    /// Adds a film. `who` are numbers one after another: threads begin at pixels that lie apart, and so do
    /// not wait for each other. Throws std::invalid_argument where it is of another image than those before.
    void add(const FilmFacts& facts, std::span<const FilmPixel> pixels, std::size_t who);
    /// Nothing where no film came. It has none then.
    std::optional<FilmSums> take();

  private:
    static constexpr std::size_t stripes = 64;
    void add_facts_of(const FilmFacts& facts);

    std::mutex mutex_;
    std::optional<FilmFacts> facts_;
    std::array<std::mutex, stripes> stripe_;
    std::vector<FilmPixel> pixels_;
};

}  // namespace ptb
