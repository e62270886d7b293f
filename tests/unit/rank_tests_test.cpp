#include "bench/compare/rank_tests.h"

#include <vector>

#include <gmock/gmock.h>

#include "bench/compare/evidence.h"
#include "bench/compare/shift.h"

namespace ptb {
namespace {

using Values = std::vector<double>;

// Charles Darwin's maize, crossed less self-fertilised, in eighths of an inch ("The Design of Experiments",
// by R. Fisher).
const Values maize{49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};
// Permeability of membranes at term and at 12 to 26 weeks ("Nonparametric Statistical Methods", by M.
// Hollander and D. Wolfe, chapter 4).
const Values at_term{0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
const Values earlier{1.15, 0.88, 0.90, 0.74, 1.21};

TEST(signed_rank, exact_p_of_a_published_sample) {
    EXPECT_NEAR(signed_rank_p(maize), 0.041259765625, 1e-12);  // 1352 of 32768
}

TEST(signed_rank, ten_of_ten_is_two_in_1024) {
    EXPECT_DOUBLE_EQ(signed_rank_p(Values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), 2.0 / 1024);
    EXPECT_DOUBLE_EQ(signed_rank_p(Values{-1, -2, -3, -4, -5, -6, -7, -8, -9, -10}), 2.0 / 1024);
}

TEST(signed_rank, zeros_are_left_out_and_ties_share_ranks) {
    // All 256 signs of the 8 ranks {2, 2, 2, 5, 5, 5, 7, 8} tried one by one.
    EXPECT_DOUBLE_EQ(signed_rank_p(Values{0, 1, 1, -1, 2, 2, 3, -2, 0, 4}), 42.0 / 256);
    EXPECT_EQ(signed_rank_p(Values{0, 0}), 1);
    EXPECT_EQ(signed_rank_p(Values{}), 1);
}

TEST(signed_rank, its_distribution_is_that_of_the_tables) {
    EXPECT_DOUBLE_EQ(signed_rank_cdf(10)[8], 25.0 / 1024);
    EXPECT_DOUBLE_EQ(signed_rank_cdf(10)[10], 43.0 / 1024);
    EXPECT_EQ(signed_rank_cdf(5).size(), 16u);
    EXPECT_DOUBLE_EQ(signed_rank_cdf(5).back(), 1);
}

TEST(rank_sum, exact_p_of_published_samples) {
    EXPECT_NEAR(rank_sum_p(at_term, earlier), 0.2544122544122544, 1e-12);
    EXPECT_NEAR(rank_sum_p(Values{19, 22, 16, 29, 24}, Values{20, 11, 17, 12}), 1.0 / 9, 1e-12);
}

TEST(rank_sum, eight_a_side_that_do_not_overlap_is_two_in_12870) {
    const Values low{1, 2, 3, 4, 5, 6, 7, 8}, high{11, 12, 13, 14, 15, 16, 17, 18};
    EXPECT_NEAR(rank_sum_p(low, high), 2.0 / 12870, 1e-15);
    EXPECT_NEAR(rank_sum_p(high, low), 2.0 / 12870, 1e-15);
}

TEST(rank_sum, its_distribution_is_that_of_the_tables) {
    // Of the 10 choices of 2 ranks of 5: U = 0, 1, 2, 2, 3, 3, 4, 4, 5, 6.
    EXPECT_THAT(rank_sum_cdf(2, 3),
                testing::Pointwise(testing::DoubleEq(), {0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0}));
}

TEST(rank_sum, ties_share_ranks) {
    // 19 of the 462 choices of 5 ranks add up to as little.
    EXPECT_NEAR(rank_sum_p(Values{1, 2, 2, 3, 5}, Values{2, 4, 5, 5, 6, 7}), 38.0 / 462, 1e-12);
    EXPECT_EQ(rank_sum_p(Values{1, 1}, Values{1, 1, 1}), 1);
    EXPECT_EQ(rank_sum_p(Values{}, Values{1}), 1);
}

TEST(rank_sum, many_values_take_the_normal_limit) {
    Values base, now;
    for (int i = 0; i < 60; ++i) base.push_back(i * 7 % 101);
    for (int i = 0; i < 70; ++i) now.push_back((i * 13 + 9) % 103 + 5);
    EXPECT_NEAR(rank_sum_p(base, now), 0.2202062267133108, 1e-9);
    EXPECT_EQ(rank_sum_p(Values(100, 1.0), Values(100, 1.0)), 1);
    EXPECT_NEAR(rank_sum_cdf(50, 50)[1249], 0.5, 0.01);
}

TEST(shift, centre_and_interval_of_a_published_sample) {
    const Shift shift = centre(maize, 0.95);
    EXPECT_DOUBLE_EQ(shift.value, 25);
    ASSERT_TRUE(shift.interval);
    EXPECT_DOUBLE_EQ(shift.interval->low, 4);
    EXPECT_DOUBLE_EQ(shift.interval->high, 41.5);
}

TEST(shift, between_two_published_samples) {
    const Shift shift = shift_between(earlier, at_term, 0.95);
    EXPECT_NEAR(shift.value, 0.305, 1e-12);
    ASSERT_TRUE(shift.interval);
    EXPECT_NEAR(shift.interval->low, -0.15, 1e-12);
    EXPECT_NEAR(shift.interval->high, 0.76, 1e-12);
}

TEST(shift, too_few_values_have_no_interval) {
    EXPECT_FALSE(centre(Values{1, 2, 3, 4, 5}, 0.95).interval);
    EXPECT_TRUE(centre(Values{1, 2, 3, 4, 5, 6}, 0.95).interval);
    EXPECT_FALSE(shift_between(Values{1, 2, 3}, Values{1, 2, 3}, 0.95).interval);
    EXPECT_TRUE(shift_between(Values{1, 2, 3, 4}, Values{1, 2, 3, 4}, 0.95).interval);
    EXPECT_DOUBLE_EQ(shift_between(Values{1}, Values{3}, 0.95).value, 2);
}

TEST(holm, multiplies_the_smallest_most_and_never_falls) {
    EXPECT_EQ(holm(Values{0.01, 0.04, 0.03}), (Values{0.03, 0.06, 0.06}));
    EXPECT_EQ(holm(Values{0.5, 0.9}), (Values{1, 1}));
    EXPECT_EQ(holm(Values{}), Values{});
}

TEST(prediction, is_students_interval_for_one_more_value) {
    const auto p = predict(Values{1.0, 1.2, 0.9, 1.1, 1.05}, Values{1.4}, 0.95);
    ASSERT_TRUE(p);
    EXPECT_NEAR(p->difference, 0.35, 1e-12);
    EXPECT_NEAR(p->p, 0.04603448518222349, 1e-9);
    EXPECT_NEAR(p->low, 0.009956309670872132, 1e-9);
    EXPECT_NEAR(p->high, 0.6900436903291276, 1e-9);
    EXPECT_FALSE(predict(Values{1}, Values{1}, 0.95));
}

TEST(smallest_effect, is_the_larger_of_power_and_noise) {
    EXPECT_DOUBLE_EQ(smallest_effect(0.05, 0.01), 0.059);
    EXPECT_DOUBLE_EQ(smallest_effect(0.05, 0.02), 0.1);
    EXPECT_DOUBLE_EQ(smallest_effect(0.05, 0), 0.05);
}

}  // namespace
}  // namespace ptb
