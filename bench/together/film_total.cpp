#include "bench/together/film_total.h"

#include <stdexcept>
#include <utility>

namespace ptb {

FilmTotal::FilmTotal(Size size) : pixels_(size.pixels()) {}

void FilmTotal::add_facts_of(const FilmFacts& facts) {
    const std::lock_guard lock(mutex_);
    if (facts_)
        add_facts(*facts_, facts);
    else
        facts_ = facts;
}

void FilmTotal::add(const FilmFacts& facts, std::span<const FilmPixel> pixels, std::size_t who) {
    if (pixels.size() != pixels_.size()) throw std::invalid_argument("the film is of another size");
    add_facts_of(facts);
    const std::span<FilmPixel> sums = pixels_;
    for (std::size_t i = 0; i < stripes; ++i) {
        const std::size_t s = (i + 7 * who) % stripes;
        const std::size_t first = pixels_.size() * s / stripes, end = pixels_.size() * (s + 1) / stripes;
        const std::lock_guard lock(stripe_[s]);
        add_pixels(sums.subspan(first, end - first), pixels.subspan(first, end - first));
    }
}

std::optional<FilmSums> FilmTotal::take() {
    if (!facts_) return std::nullopt;
    return FilmSums{*std::exchange(facts_, std::nullopt), std::move(pixels_)};
}

}  // namespace ptb
