#include <gtest/gtest.h>

#include "bench/validate/validate.h"

namespace ptb {
namespace {

constexpr Size edge{64, 64}, film_edge{32, 32};
constexpr int spp = 100, reference_spp = 1000;

/// A grey reference of which no path reached full length.
Reference without_full_paths() {
    Reference reference;
    reference.size = edge;
    reference.spp = reference_spp;
    reference.segments_per_sample = 2;
    reference.segments_variance = 1;
    reference.mean = {edge, std::vector<float>(edge.pixels() * 3, 0.5f)};
    reference.variance = {edge, std::vector<float>(edge.pixels() * 3, 1.0f)};
    return reference;
}

Validation of_film_with(std::uint64_t full_length_paths) {
    const Reference reference = without_full_paths();
    Film film;
    film.mean = {film_edge, std::vector<float>(film_edge.pixels() * 3, 0.5f)};
    film.samples = film_edge.pixels() * spp;
    film.segments = 2 * *film.samples;
    film.full_length_paths = full_length_paths;
    const FilmEvidence evidence{film, film_edge, spp, 128};
    Validation validation = check_film(evidence);
    check_against(validation, evidence, reference);
    return validation;
}

TEST(FullLength, a_share_so_rare_that_the_reference_has_none_is_no_error) {
    EXPECT_TRUE(of_film_with(0).valid);
    const Validation few = of_film_with(1);
    EXPECT_TRUE(few.valid) << few.reason;
}

TEST(FullLength, a_share_that_chance_does_not_explain_is_one) {
    EXPECT_FALSE(of_film_with(5).valid) << "5 in 100,000";
    const Validation many = of_film_with(400);
    EXPECT_FALSE(many.valid);
    EXPECT_NE(many.reason.find("full length"), std::string::npos) << many.reason;
}

}  // namespace
}  // namespace ptb
