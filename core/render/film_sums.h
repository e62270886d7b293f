#pragma once

#include <span>
#include <vector>

#include "core/image/image.h"
#include "shared/engine.h"

namespace ptb {

struct Film;

/// What one unit of a film's sums is worth: 2^-radiance of radiance, 2^-squares of its square.
struct FilmScale {
    int radiance = 0, squares = 0;
    bool operator==(const FilmScale&) const = default;
};

/// What a film's sums are of, and what they have beside pixels.
struct FilmFacts {
    Size size;
    FilmScale scale{};
    bool has_variance = false;         ///< the samples of a pixel are its own
    std::uint64_t light_segments = 0;  ///< of paths that start at lamps or are shifted
    bool operator==(const FilmFacts&) const = default;
};

/// A film as a device sums it, in whole numbers. Sums of parts of an image add up to the image's, bit by bit,
/// in any order.
struct FilmSums {
    FilmFacts facts;
    std::vector<FilmPixel> pixels{};  ///< in rows from the top
};

/// Adds what other parts of the same image have. Throw std::invalid_argument where they are of another.
void add_facts(FilmFacts& sums, const FilmFacts& others);
void add_sums(FilmSums& sums, const FilmSums& others);

/// Adds those of others to as many pixels. Throws std::invalid_argument where they are not as many.
void add_pixels(std::span<FilmPixel> sums, std::span<const FilmPixel> others);

/// The picture and the counts of some pixels, added to `film` from pixel `first` on, with the variance where
/// it has one. A broken sum is NaN.
void store_pixels(std::span<const FilmPixel> pixels, std::size_t first, const FilmScale& scale, Film& film);

/// A film without a sample.
Film empty_film(Size size, bool has_variance);

/// The picture, with the hash that the film would have had on one device.
Film film_of(const FilmSums& sums);

}  // namespace ptb
