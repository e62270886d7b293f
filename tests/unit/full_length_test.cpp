#include <cstdint>
#include <string>

#include <gmock/gmock.h>

#include "bench/validate/validate.h"

namespace ptb {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr Size size{100, 100};
constexpr int spp = 1000;  // 10 million samples

Image even(float value) { return {size, std::vector<float>(3 * size.pixels(), value)}; }

Reference reference_with(double full_length_share) {
    Reference reference;
    reference.size = size;
    reference.spp = 4 * spp;
    reference.segments_per_sample = 2;
    reference.segments_variance = 1;
    reference.full_length_share = full_length_share;
    reference.mean = even(0.5F);
    reference.variance = even(1);
    return reference;
}

Film film_with(std::uint64_t full_length_paths) {
    Film film;
    film.mean = even(0.5F);
    film.variance = even(1);
    film.samples = size.pixels() * spp;
    film.segments = 2 * *film.samples;
    film.full_length_paths = full_length_paths;
    return film;
}

std::string reason_of(const Film& film, const Reference& reference, Roulette roulette = Roulette::off) {
    const FilmEvidence evidence{film, size, spp, 128, roulette};
    Validation validation = check_film(evidence);
    check_against(validation, evidence, reference);
    return validation.reason;
}

/// Why a film with so many full-length paths is refused beside a reference with this share of them.
std::string reason_of(std::uint64_t full_length_paths, double expected_share) {
    return reason_of(film_with(full_length_paths), reference_with(expected_share));
}

TEST(FullLength, a_few_paths_kept_in_glass_by_rounding_are_no_fault) {
    EXPECT_THAT(reason_of(0, 0), Not(HasSubstr("full length")));
    EXPECT_THAT(reason_of(4, 0), Not(HasSubstr("full length")));
}

TEST(FullLength, lost_paths_are_a_fault_where_the_reference_has_none) {
    EXPECT_THAT(reason_of(30, 0), HasSubstr("0.00030 % of the paths reach full length"));
}

TEST(FullLength, shares_differ_by_less_than_four_standard_errors) {
    // 0.001 of 10 and of 40 million: 112 paths of 10 million are one standard error
    EXPECT_THAT(reason_of(10'000 + 400, 1e-3), Not(HasSubstr("full length")));
    EXPECT_THAT(reason_of(10'000 + 500, 1e-3), HasSubstr("full length"));
    EXPECT_THAT(reason_of(10'000 - 500, 1e-3), HasSubstr("full length"));
}

TEST(FullLength, where_every_path_has_it_none_may_lack_it) {
    EXPECT_THAT(reason_of(size.pixels() * spp, 1), Not(HasSubstr("full length")));
    EXPECT_THAT(reason_of(size.pixels() * spp - 2000, 1), HasSubstr("full length"));
}

TEST(Roulette, paths_that_end_by_chance_need_not_be_as_long_as_the_references) {
    Film film = film_with(10);
    film.segments = *film.samples;
    EXPECT_THAT(reason_of(film, reference_with(1e-3)), HasSubstr("1.000 segments a sample"));
    EXPECT_EQ(reason_of(film, reference_with(1e-3), Roulette::albedo), "");
}

TEST(Roulette, means_may_differ_by_as_much_as_the_films_own_noise_explains) {
    const Reference reference = reference_with(0);
    const auto reason_of_timed = [&](const Film& film, Roulette roulette) {
        const FilmEvidence evidence{film, size, spp, 128, roulette};
        Validation validation = check_film(evidence);
        check_timed(validation, evidence, reference);
        return validation.reason;
    };
    Film film = film_with(0);
    film.mean = even(0.502F);  // 5.7 of the reference's standard errors, 1.8 of ten times its variance
    EXPECT_THAT(reason_of_timed(film, Roulette::albedo), HasSubstr("image mean: red is 0.50200"));
    film.variance = even(10);
    EXPECT_EQ(reason_of_timed(film, Roulette::albedo), "");
    EXPECT_THAT(reason_of_timed(film, Roulette::off), HasSubstr("image mean: red is 0.50200"));
}

}  // namespace
}  // namespace ptb
