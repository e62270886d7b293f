#include "bench/validate/noise.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "bench/validate/blocks.h"

namespace ptb {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

/// Grey pixels of these values.
Image grey(Size size, const std::vector<float>& values) {
    Image image{size, {}};
    for (const float value : values) image.rgb.insert(image.rgb.end(), {value, value, value});
    return image;
}

Image flat(Size size, float value) { return grey(size, std::vector<float>(size.pixels(), value)); }

Reference reference(Image mean, float variance = 0) {
    Reference r;
    r.size = mean.size;
    r.spp = 1000;
    r.variance = flat(mean.size, variance);
    r.mean = std::move(mean);
    return r;
}

/// Of a film of which only the variance counts.
Efficiency noise(Image variance, int spp, const Reference& truth) {
    Film film;
    film.mean = variance;
    film.variance = std::move(variance);
    return noise_of({film, film.mean.size, spp, 5}, truth);
}

const Reference four_pixels = reference(grey({2, 2}, {1, 2, 3, 6}));

TEST(Noise, is_the_variance_over_mean_and_median_of_the_reference) {
    const auto e = noise(flat({2, 2}, 0.5F), 10, four_pixels);
    // 0.05 / (mean^2 + 0.01 2.5^2) of the four, their mean and its standard error.
    EXPECT_THAT(e.all->rel_mse, DoubleNear(0.0165675597, 1e-9));
    EXPECT_THAT(e.all->standard_error, DoubleNear(0.0104100845, 1e-9));
    EXPECT_EQ(e.variance_from, "film");
    EXPECT_EQ(e.reason, "");
}

TEST(Noise, a_channel_s_unit_does_not_matter) {
    Reference coloured = four_pixels;
    Image variance = flat({2, 2}, 0.5F);
    for (std::size_t i = 1; i < 12; i += 3) coloured.mean.rgb[i] *= 8;
    for (std::size_t i = 1; i < 12; i += 3) variance.rgb[i] *= 64;
    EXPECT_THAT(noise(variance, 10, coloured).all->rel_mse, DoubleNear(0.0165675597, 1e-9))
        << "medians are not the channels' own";
}

TEST(Noise, the_worst_hundredth_of_the_pixels_is_left_out_of_the_rest) {
    std::vector<float> variances(200, 1.01F);
    variances[17] = variances[140] = 1010;
    const auto e = noise(grey({20, 10}, variances), 1, reference(flat({20, 10}, 1)));
    EXPECT_EQ(e.reason, "spp 1: a single sample per pixel has no variance");
    for (float& v : variances) v *= 4;
    const auto four = noise(grey({20, 10}, variances), 4, reference(flat({20, 10}, 1)));
    EXPECT_THAT(four.all->rel_mse, DoubleNear((198 + 2000) / 200.0, 1e-4));
    EXPECT_THAT(four.best_99->rel_mse, DoubleNear(1, 1e-6));
    EXPECT_THAT(four.best_99->standard_error, DoubleNear(0, 1e-6));
    EXPECT_GT(four.all->standard_error, 1);
}

TEST(Noise, other_sizes_take_blocks_of_the_reference_or_repeat_its_pixels) {
    const Reference large = reference(grey({4, 4}, {0, 2, 1, 3, 2, 0, 3, 1, 3, 3, 6, 6, 3, 3, 6, 6}));
    const auto smaller = noise(flat({2, 2}, 0.5F), 10, large);  // blocks' means are 1, 2, 3, 6
    EXPECT_THAT(smaller.all->rel_mse, DoubleNear(0.0165675597, 1e-9));
    const auto larger = noise(flat({6, 6}, 0.5F), 10, four_pixels);
    EXPECT_THAT(larger.all->rel_mse, DoubleNear(0.0165675597, 1e-9));
    EXPECT_THAT(noise(flat({3, 3}, 1), 10, four_pixels).reason, HasSubstr("size 3x3: neither a multiple"));
    EXPECT_THAT(noise(flat({2, 4}, 1), 10, four_pixels).reason, HasSubstr("2x4"));
}

TEST(Noise, a_film_without_squares_has_the_variance_of_its_reference) {
    Film film;
    film.mean = flat({2, 2}, 1);
    const auto e = noise_of({film, {2, 2}, 10, 5}, reference(grey({2, 2}, {1, 2, 3, 6}), 0.5F));
    EXPECT_THAT(e.all->rel_mse, DoubleNear(0.0165675597, 1e-9));
    EXPECT_EQ(e.variance_from, "reference");
}

TEST(Noise, a_sample_of_a_block_is_one_of_any_of_its_pixels) {
    const auto moments = moments_at({grey({2, 1}, {1, 3}), flat({2, 1}, 0.25F)}, {1, 1});
    EXPECT_FALSE(moments) << "a block is as wide as high";
    const auto square = moments_at({grey({2, 2}, {1, 3, 3, 1}), flat({2, 2}, 0.25F)}, {1, 1});
    ASSERT_TRUE(square);
    EXPECT_THAT(square->mean.rgb, ElementsAre(2, 2, 2));
    EXPECT_THAT(square->variance.rgb, ElementsAre(1.25F, 1.25F, 1.25F)) << "0.25 within, 1 between";
}

TEST(Noise, where_nothing_is_random_there_is_none_even_in_the_dark) {
    auto variances = std::vector<float>(4, 0.5F);
    variances[0] = 0;
    EXPECT_TRUE(noise(grey({2, 2}, variances), 4, reference(grey({2, 2}, {0, 0, 1, 1}))).all);
    EXPECT_EQ(noise(grey({2, 2}, {1, 0, 0, 0}), 4, reference(flat({2, 2}, 0))).reason,
              "the image has noise where its reference is black");
}

/// The squared error of an image that nobody told the variance of.
TEST(Noise, is_the_squared_error_to_be_expected) {
    constexpr Size size{96, 96};
    constexpr int spp = 16;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto pixels = size.pixels();
    Film film;
    film.mean = film.variance.emplace(flat(size, 0));
    std::vector<float> truth;
    double squared = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        truth.push_back(static_cast<float>(0.5 + uniform(random)));
        double sum = 0, squares = 0;
        for (int s = 0; s < spp; ++s) {
            const double value = 2 * static_cast<double>(truth[i]) * uniform(random);
            sum += value;
            squares += value * value;
        }
        const double mean = sum / spp, variance = (squares - spp * mean * mean) / (spp - 1);
        for (std::size_t c = 0; c < 3; ++c) film.variance->rgb[3 * i + c] = static_cast<float>(variance);
        const double difference = mean - static_cast<double>(truth[i]), m = static_cast<double>(truth[i]);
        squared += difference * difference / (m * m + 0.01) / static_cast<double>(pixels);
    }
    const auto e = noise_of({film, size, spp, 5}, reference(grey(size, truth)));
    EXPECT_THAT(e.all->rel_mse / squared, DoubleNear(1, 0.06)) << "4 standard errors of 9216 squares";
    EXPECT_LT(e.all->standard_error / e.all->rel_mse, 0.01);
}

TEST(Noise, of_pairs_is_half_the_squared_difference_in_samples_of_the_image) {
    PairedNoise paired(four_pixels, {2, 2}, 40, 10);
    EXPECT_EQ(paired.refusal(), "");
    const Image ones = flat({2, 2}, 1);
    paired.add(ones, flat({2, 2}, 2));  // half of 1 for ten samples, an eighth for forty
    paired.add(flat({2, 2}, 3), ones);  // half of 4
    const auto e = paired.noise();
    EXPECT_THAT(e.all->rel_mse, DoubleNear(0.0165675597 * 2.5 * 2.5, 1e-7)) << "0.3125, and not 0.05";
    EXPECT_THAT(e.all->standard_error, DoubleNear(0.0165675597 * 2.5 * 1.5, 1e-7)) << "1 and 4 of the pairs";
    EXPECT_EQ(e.variance_from, "passes");
    EXPECT_THAT(PairedNoise(four_pixels, {3, 3}, 40, 10).refusal(), HasSubstr("neither a multiple"));
}

TEST(Noise, of_pairs_leaves_out_the_worst_hundredth_of_the_pixels) {
    const Size size{20, 10};
    std::vector<float> values(200, 2);
    values[17] = values[140] = 101;
    PairedNoise paired(reference(flat(size, 1)), size, 1, 1);
    for (int i = 0; i < 2; ++i) paired.add(grey(size, values), flat(size, 1));
    EXPECT_THAT(paired.noise().best_99->rel_mse, DoubleNear(0.5 / 1.01, 1e-6));
    EXPECT_THAT(paired.noise().all->rel_mse, DoubleNear((198 * 0.5 + 2 * 5000) / 1.01 / 200, 1e-3));
}

Efficiency known(double rel_mse, double standard_error) {
    Efficiency e;
    e.all = e.best_99 = Noise{rel_mse, standard_error, {}, {}, {}};
    return e;
}

Statistics two_seconds(double low_s, double high_s) {
    Statistics s;
    s.median_ns = 2e9;
    s.ci_low_ns = low_s * 1e9;
    s.ci_high_ns = high_s * 1e9;
    return s;
}

TEST(Noise, efficiency_is_one_over_noise_and_seconds) {
    Efficiency e = known(0.25, 0);
    add_efficiency(e, two_seconds(1.9, 2.2));
    EXPECT_DOUBLE_EQ(*e.all->efficiency, 2);
    EXPECT_THAT(*e.all->low, DoubleNear(2 * 2 / 2.2, 1e-9)) << "of the longest time";
    EXPECT_THAT(*e.all->high, DoubleNear(2 * 2 / 1.9, 1e-9));
    EXPECT_EQ(e.best_99, e.all);
}

TEST(Noise, the_errors_of_noise_and_time_come_together_as_independent_ones) {
    Efficiency e = known(0.25, 0.025);
    const double time = std::exp(0.3);
    add_efficiency(e, two_seconds(2 / time, 2 * time));
    const double error = std::sqrt(0.3 * 0.3 + 0.1959964 * 0.1959964);
    EXPECT_THAT(*e.all->low, DoubleNear(2 * std::exp(-error), 1e-6));
    EXPECT_THAT(*e.all->high, DoubleNear(2 * std::exp(error), 1e-6));
}

TEST(Noise, a_time_without_an_interval_gives_none) {
    Efficiency e = known(0.25, 0.025);
    Statistics few;
    few.median_ns = 2e9;
    add_efficiency(e, few);
    EXPECT_DOUBLE_EQ(*e.all->efficiency, 2);
    EXPECT_FALSE(e.all->low || e.all->high);
}

TEST(Noise, an_image_without_noise_has_no_efficiency) {
    Efficiency e = known(1e-8, 0);
    add_efficiency(e, two_seconds(1.9, 2.2));
    EXPECT_FALSE(e.all->efficiency);
    EXPECT_THAT(e.reason, HasSubstr("rounding"));
}

}  // namespace
}  // namespace ptb
