#include "bench/validate/passes.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "bench/validate/validate.h"

namespace ptb {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;

TEST(Passes, a_student_is_as_unlikely_as_the_normal_number_it_is_told_as) {
    EXPECT_DOUBLE_EQ(student_z(3, 4, 0, 15), 1.5) << "nothing is estimated";
    EXPECT_THAT(student_z(2.13145, 0, 1, 15), DoubleNear(1.95996, 2e-4)) << "the 2.5 % of tables";
    EXPECT_THAT(student_z(-4.0728, 0, 1, 15), DoubleNear(-3.29053, 2e-3)) << "0.05 %";
    EXPECT_GT(student_z(6, 9, 1, 15), student_z(6, 0, 10, 15)) << "what is known has no tail";
    EXPECT_TRUE(std::isfinite(student_z(1e9, 0, 1, 31)));
}

Film grey_film(Size size, float value) {
    Film film;
    film.mean = {size, std::vector<float>(3 * size.pixels(), value)};
    film.samples = film.full_length_paths = size.pixels();
    film.segments = 4 * size.pixels();
    film.light_segments = 3;
    return film;
}

TEST(Passes, together_they_are_the_mean_picture_and_all_the_counts) {
    Passes passes{1, {grey_film({2, 2}, 1), grey_film({2, 2}, 2), grey_film({2, 2}, 6)}};
    const Film film = together(passes);
    EXPECT_THAT(film.mean.rgb, testing::Each(3.0F));
    EXPECT_EQ(film.samples, 12U);
    EXPECT_EQ(film.full_length_paths, 12U);
    EXPECT_EQ(film.segments, 48U);
    EXPECT_EQ(film.light_segments, 9U);
    EXPECT_FALSE(film.variance);
}

TEST(Passes, the_variance_of_a_block_s_mean_is_told_of_one_sample) {
    Passes passes{5, {grey_film({4, 2}, 1), grey_film({4, 2}, 3)}};  // variance 2 of means of 4 x 5 samples
    const Blocks blocks = block_variance_of_sample(passes, 2);
    EXPECT_THAT(blocks.rgb, testing::ElementsAre(40, 40, 40, 40, 40, 40));
    EXPECT_THAT(image_variance_of_sample(passes), testing::ElementsAre(80, 80, 80));
}

/// Passes whose pixels all have the same error, as if they shared all their paths.
struct Shared {
    Passes passes{10, {}};
    Reference truth;
    Film film;

    explicit Shared(double error) {
        constexpr Size size{128, 128};
        truth.size = size;
        truth.spp = 1'000'000;
        truth.segments_per_sample = 4;
        truth.segments_variance = 1;
        truth.full_length_share = 1;
        truth.mean = {size, std::vector<float>(3 * size.pixels(), 1.0F)};
        truth.variance = {size, std::vector<float>(3 * size.pixels(), 0.01F)};
        std::mt19937 random(3);
        std::normal_distribution<double> normal(0, 0.01);
        for (int i = 0; i < enough_passes; ++i) {
            passes.films.push_back(grey_film(size, static_cast<float>(1 + normal(random) + error)));
            for (auto* count : {&*passes.films.back().samples, &*passes.films.back().full_length_paths,
                                &passes.films.back().segments})
                *count *= 10;
        }
        film = together(passes);
    }

    Validation judged(const Passes* told) const {
        const FilmEvidence evidence{film, truth.size, 10 * enough_passes, 4, Roulette::off, told};
        Validation validation = check_film(evidence);
        check_against(validation, evidence, truth);
        return validation;
    }
};

TEST(Passes, errors_that_pixels_share_are_no_fault_where_passes_tell_them) {
    const Shared right(0);
    EXPECT_TRUE(right.judged(&right.passes).valid) << right.judged(&right.passes).reason;
    EXPECT_THAT(right.judged(&right.passes).checks, Contains("blocks"));
    EXPECT_THAT(right.judged(&right.passes).checks, Not(Contains("neighbours")));
    EXPECT_FALSE(right.judged(nullptr).valid) << "as independent pixels they would be wrong";
}

TEST(Passes, a_fault_beyond_them_is_found) {
    const Shared wrong(0.02);  // eleven standard errors of 32 passes
    EXPECT_THAT(wrong.judged(&wrong.passes).reason, HasSubstr("block at column 0, row 0"));
}

}  // namespace
}  // namespace ptb
