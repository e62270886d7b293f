#include "core/render/film_sums.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "bench/worker/film_file.h"
#include "core/render/render.h"

namespace ptb {
namespace {

FilmPixel pixel(ptb_long radiance, ptb_uint samples) {
    FilmPixel made{};
    for (std::size_t c = 0; c < 3; ++c) {
        made.radiance[c] = radiance + static_cast<ptb_long>(c);
        made.squares[c] = radiance * radiance;
    }
    made.samples = samples;
    made.segments = 2 * samples;
    return made;
}

/// Of two pixels; a unit of radiance is an eighth.
FilmSums sums_of(ptb_long first, ptb_long second, ptb_uint samples) {
    return {{{2, 1}, {3, 6}, true, samples}, {pixel(first, samples), pixel(second, samples)}};
}

TEST(FilmSums, add_up_to_the_same_bits_in_any_order) {
    FilmSums one = sums_of(8, 16, 1), other = sums_of(24, 5, 3);
    add_sums(one, sums_of(24, 5, 3));
    add_sums(other, sums_of(8, 16, 1));
    EXPECT_EQ(film_of(one).hash, film_of(other).hash);
    const Film film = film_of(one);
    EXPECT_EQ(film.samples, 8u);
    EXPECT_EQ(film.segments, 16u);
    EXPECT_EQ(film.light_segments, 4u);
    EXPECT_FLOAT_EQ(film.mean.rgb[0], 32.0f / 8 / 4) << "32 units of an eighth, of four samples";
    EXPECT_NE(film.hash, film_of(sums_of(8, 16, 1)).hash);
}

TEST(FilmSums, a_broken_sum_stays_broken) {
    FilmSums broken = sums_of(8, 16, 1);
    broken.pixels[1].radiance[2] = FILM_BROKEN;
    FilmSums sums = sums_of(-5, 7, 1);
    add_sums(sums, broken);
    EXPECT_TRUE(std::isnan(film_of(sums).mean.rgb[5]));
    EXPECT_FALSE(std::isnan(film_of(sums).mean.rgb[4]));
    add_sums(broken, sums_of(-5, 7, 1));
    EXPECT_EQ(broken.pixels[1].radiance[2], FILM_BROKEN);
}

TEST(FilmSums, of_another_image_are_refused) {
    FilmSums sums = sums_of(1, 2, 1);
    FilmSums scaled = sums;
    scaled.facts.scale.radiance = 4;
    EXPECT_THROW(add_sums(sums, scaled), std::invalid_argument);
    FilmSums wider = sums;
    wider.facts.size = {1, 2};
    EXPECT_THROW(add_sums(sums, wider), std::invalid_argument);
}

TEST(FilmFile, keeps_every_bit_and_refuses_what_is_cut_or_damaged) {
    const auto file = std::filesystem::temp_directory_path() / "ptb_film_sums_test.film";
    const FilmSums sums = sums_of(-8, 16, 7);
    write_film(file, sums);
    const FilmSums read = read_film(file);
    EXPECT_EQ(film_of(read).hash, film_of(sums).hash);
    EXPECT_EQ(read.facts, sums.facts);
    {
        std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
        damaged.seekp(-9, std::ios::end).put('\x7f');
    }
    EXPECT_THROW(read_film(file), std::runtime_error);
    write_film(file, sums);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
    EXPECT_THROW(read_film(file), std::runtime_error);
    std::ofstream(file) << "{}\n";
    EXPECT_THROW(read_film(file), std::runtime_error);
    std::filesystem::remove(file);
    EXPECT_THROW(read_film(file), std::runtime_error);
}

}  // namespace
}  // namespace ptb
