#include "core/render/film_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "core/render/film_hash.h"
#include "core/render/render.h"

namespace ptb {

namespace {

double unscaled(ptb_long sum, int exponent) {
    return sum == FILM_BROKEN ? std::numeric_limits<double>::quiet_NaN()
                              : std::ldexp(static_cast<double>(sum), -exponent);
}

ptb_long whole_sum(ptb_long a, ptb_long b) {
    return a == FILM_BROKEN || b == FILM_BROKEN ? FILM_BROKEN : a + b;
}

void add_pixel(FilmPixel& sum, const FilmPixel& other) {
    for (std::size_t c = 0; c < 3; ++c) {
        sum.radiance[c] = whole_sum(sum.radiance[c], other.radiance[c]);
        sum.squares[c] = whole_sum(sum.squares[c], other.squares[c]);
    }
    sum.samples += other.samples;
    sum.segments += other.segments;
    sum.full_length_paths += other.full_length_paths;
    sum.shadow_rays += other.shadow_rays;
}

}  // namespace

void add_facts(FilmFacts& sums, const FilmFacts& others) {
    if (sums.size != others.size || sums.scale != others.scale || sums.has_variance != others.has_variance)
        throw std::invalid_argument("films of two images do not add up");
    sums.light_segments += others.light_segments;
}

void add_pixels(std::span<FilmPixel> sums, std::span<const FilmPixel> others) {
    if (sums.size() != others.size()) throw std::invalid_argument("films of two sizes do not add up");
    for (std::size_t i = 0; i < sums.size(); ++i) add_pixel(sums[i], others[i]);
}

void add_sums(FilmSums& sums, const FilmSums& others) {
    add_facts(sums.facts, others.facts);
    add_pixels(sums.pixels, others.pixels);
}

void store_pixels(std::span<const FilmPixel> pixels, std::size_t first, const FilmScale& scale, Film& film) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const FilmPixel& pixel = pixels[i];
        const double n = pixel.samples;
        for (std::size_t c = 0; c < 3; ++c) {
            const double mean = n > 0 ? unscaled(pixel.radiance[c], scale.radiance) / n : 0;
            film.mean.rgb[3 * (first + i) + c] = static_cast<float>(mean);
            if (!film.variance) continue;
            const double deviations = unscaled(pixel.squares[c], scale.squares) - n * mean * mean;
            film.variance->rgb[3 * (first + i) + c] =
                n > 1 ? static_cast<float>(std::max(deviations, 0.0) / (n - 1)) : 0.0f;
        }
        *film.samples += pixel.samples;
        film.segments += pixel.segments;
        *film.full_length_paths += pixel.full_length_paths;
        film.shadow_rays += pixel.shadow_rays;
    }
}

Film empty_film(Size size, bool has_variance) {
    Film film;
    film.mean = {size, std::vector<float>(size.pixels() * 3)};
    if (has_variance) film.variance = film.mean;
    film.samples = film.full_length_paths = 0;
    return film;
}

Film film_of(const FilmSums& sums) {
    Film film = empty_film(sums.facts.size, sums.facts.has_variance);
    store_pixels(sums.pixels, 0, sums.facts.scale, film);
    film.light_segments = sums.facts.light_segments;
    FilmHash hash;
    hash.add(std::span<const FilmPixel>(sums.pixels));
    film.hash = hash.text();
    return film;
}

}  // namespace ptb
