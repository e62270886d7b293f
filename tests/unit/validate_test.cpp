#include "bench/validate/validate.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace ptb {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Optional;

constexpr Size size{64, 64};
constexpr int spp = 1000, path_length = 10;

Image flat(float value) { return {size, std::vector<float>(3 * size.pixels(), value)}; }

/// Four segments a sample, of paths of which one in four reaches its full length.
Reference reference() {
    Reference reference;
    reference.size = size;
    reference.spp = spp;
    reference.segments_per_sample = 4;
    reference.segments_variance = 1;
    reference.full_length_share = 0.25;
    reference.mean = flat(1);
    reference.variance = flat(0.5f);
    return reference;
}

Film film(double segments_per_sample, double full_length_share, float radiance = 1) {
    const double samples = static_cast<double>(size.pixels()) * spp;
    Film film;
    film.mean = flat(radiance);
    film.samples = size.pixels() * spp;
    film.segments = static_cast<std::uint64_t>(samples * segments_per_sample);
    film.full_length_paths = static_cast<std::uint64_t>(samples * full_length_share);
    return film;
}

RenderJob job(Roulette roulette) {
    RenderJob job{size, spp, path_length};
    job.variant.roulette = roulette;
    return job;
}

enum class Against { reference, timed };

Validation judged(const Film& film, Roulette roulette, Against against = Against::reference) {
    const FilmEvidence evidence = evidence_of(film, job(roulette));
    Validation validation = check_film(evidence);
    if (against == Against::reference)
        check_against(validation, evidence, reference());
    else
        check_timed(validation, evidence, reference());
    return validation;
}

TEST(Validate, the_right_film_passes_every_check) {
    const Validation validation = judged(film(4, 0.25), Roulette::off);
    EXPECT_TRUE(validation.valid) << validation.reason;
    EXPECT_THAT(validation.checks,
                ElementsAre("finite", "counts", "segments", "full_length", "blocks", "mean", "neighbours"));
    EXPECT_EQ(validation.reference_segments_per_sample, 4);
}

TEST(Validate, paths_of_other_lengths_are_wrong) {
    EXPECT_THAT(judged(film(3.9, 0.25), Roulette::off).reason, HasSubstr("segments a sample"));
    EXPECT_THAT(judged(film(4, 0.24), Roulette::off).reason, HasSubstr("reach full length"));
    EXPECT_THAT(judged(film(3.9, 0.25), Roulette::off, Against::timed).reason,
                HasSubstr("segments a sample"));
}

TEST(Validate, paths_that_roulette_ends_have_no_length_to_compare) {
    for (const Against against : {Against::reference, Against::timed}) {
        const Validation validation = judged(film(2, 0), Roulette::albedo, against);
        EXPECT_TRUE(validation.valid) << validation.reason;
        EXPECT_THAT(validation.checks, Not(Contains("segments")));
        EXPECT_THAT(validation.checks, Not(Contains("full_length")));
        EXPECT_THAT(validation.checks, Contains("mean"));
        EXPECT_EQ(validation.reference_segments_per_sample, std::nullopt);
    }
}

TEST(Validate, roulette_excuses_nothing_else) {
    EXPECT_THAT(judged(film(2, 0, 1.01f), Roulette::albedo).reason, HasSubstr("standard errors"));
    EXPECT_THAT(judged(film(2, 0, 1.01f), Roulette::albedo, Against::timed).reason, HasSubstr("image mean"));
    EXPECT_THAT(judged(film(path_length + 1, 0), Roulette::albedo).reason, HasSubstr("between 1 and 10"));
    Film lost = film(2, 0);
    *lost.samples -= 1;
    EXPECT_THAT(judged(lost, Roulette::albedo).reason, HasSubstr("samples counted"));
    lost = film(2, 0);
    lost.mean.rgb[3 * 65] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(judged(lost, Roulette::albedo).reason, HasSubstr("nan at column 1, row 1"));
}

TEST(Validate, what_roulette_spares_may_vary_as_much_as_the_film_says) {
    Film noisy = film(2, 0, 1.003f);  // six standard errors by the reference, 3.5 by the film
    noisy.variance = flat(2.5f);
    EXPECT_THAT(judged(noisy, Roulette::albedo, Against::timed).mean_z, Optional(DoubleNear(3.5, 0.1)));
    EXPECT_TRUE(judged(noisy, Roulette::albedo, Against::timed).valid);
    noisy.variance = flat(0.1f);
    EXPECT_FALSE(judged(noisy, Roulette::albedo, Against::timed).valid) << "but not less than the reference";
    noisy.variance = flat(2.5f);
    noisy.segments *= 2;
    EXPECT_THAT(judged(noisy, Roulette::off, Against::timed).reason, HasSubstr("image mean"));
}

TEST(Validate, the_same_work_has_the_same_bits_and_counts) {
    const auto same = [](const Film& other) {
        Validation validation;
        validation.valid = true;
        check_same_bits(validation, film(4, 0.25), other, "work-group 8");
        return validation;
    };
    EXPECT_TRUE(same(film(4, 0.25)).valid);
    EXPECT_THAT(same(film(4, 0.25)).checks, ElementsAre("work-group 8"));
    Film other = film(4, 0.25);
    other.mean.rgb[5] = std::nextafter(other.mean.rgb[5], 2.0f);
    EXPECT_EQ(same(other).reason, "the same work gave other bits: work-group 8");
    other = film(4, 0.25);
    other.segments += 1;
    EXPECT_FALSE(same(other).valid);
    other = film(4, 0.25);
    other.shadow_rays += 1;
    EXPECT_FALSE(same(other).valid);
}

}  // namespace
}  // namespace ptb
