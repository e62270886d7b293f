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

std::string reason_of(const Film& film, const Reference& reference) {
    const FilmEvidence evidence{film, size, spp, 128};
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
    EXPECT_THAT(reason_of(100, 0), HasSubstr("0.00100 % of the paths reach full length"));
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

}  // namespace
}  // namespace ptb
