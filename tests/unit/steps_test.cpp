#include "bench/compare/steps.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace ptb {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::Ge;
using testing::IsEmpty;
using testing::Le;

const StepRules five_percent{std::log(1.05) / 2, 1};

/// Normal noise of 1 % about 0.
std::vector<double> flat(std::size_t n, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<> noise(0, 0.01);
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) values.push_back(noise(random));
    return values;
}

std::vector<double> raised(std::vector<double> values, std::size_t from, std::size_t to, double by) {
    for (std::size_t i = from; i < to; ++i) values[i] += by;
    return values;
}

auto step_near(std::size_t at, bool suspected = false) {
    return AllOf(Field(&Step::at, AllOf(Ge(at - 1), Le(at + 1))), Field(&Step::suspected, suspected));
}

TEST(steps, a_step_is_found_where_it_is_and_as_large_as_it_is) {
    const auto found = steps(raised(flat(30), 17, 30, 0.06), five_percent);
    ASSERT_THAT(found, ElementsAre(step_near(17)));
    EXPECT_NEAR(found[0].shift.value, 0.06, 0.01);
    EXPECT_LT(found[0].shift.interval->low, 0.06);
    EXPECT_GT(found[0].shift.interval->high, 0.06);
    EXPECT_LT(found[0].p, 1e-3);
}

TEST(steps, what_comes_and_goes_is_two_steps) {
    const auto found = steps(raised(flat(30), 10, 20, 0.08), five_percent);
    ASSERT_THAT(found, ElementsAre(step_near(10), step_near(20)));
    EXPECT_GT(found[0].shift.value, 0.06);
    EXPECT_LT(found[1].shift.value, -0.06);
}

TEST(steps, stairs_are_found_one_by_one) {
    auto values = raised(raised(flat(45), 15, 45, 0.06), 30, 45, 0.06);
    EXPECT_THAT(steps(values, five_percent), ElementsAre(step_near(15), step_near(30)));
}

TEST(steps, smaller_changes_than_asked_for_are_not_told) {
    EXPECT_THAT(steps(raised(flat(40), 20, 40, 0.02), five_percent), IsEmpty());
    EXPECT_THAT(steps(raised(flat(40), 20, 40, 0.02), {0.01, 1}), ElementsAre(step_near(20)));
}

TEST(steps, one_value_far_off_is_none) {
    EXPECT_THAT(steps(raised(flat(30), 12, 13, 0.5), five_percent), IsEmpty());
    EXPECT_THAT(steps(raised(flat(30), 29, 30, 0.5), five_percent), IsEmpty());
}

TEST(steps, disturbed_runs_do_not_hide_a_step) {
    auto values = raised(flat(30), 15, 30, 0.05);
    for (const std::size_t disturbed : {1u, 9u, 22u}) values[disturbed] += 0.4;
    EXPECT_THAT(steps(values, five_percent), ElementsAre(step_near(15)));
}

TEST(steps, of_the_newest_values_two_are_enough_to_suspect) {
    EXPECT_THAT(steps(raised(flat(20), 18, 20, 0.10), five_percent), ElementsAre(step_near(18, true)));
}

TEST(steps, equal_values_and_short_series_have_none) {
    EXPECT_THAT(steps(std::vector<double>(30, 1.5), five_percent), IsEmpty());
    EXPECT_THAT(steps(std::vector<double>{}, five_percent), IsEmpty());
    EXPECT_THAT(steps(std::vector<double>{1, 2, 1, 2, 9, 9, 9, 9}, five_percent), IsEmpty());
}

TEST(steps, searching_many_series_asks_for_more) {
    const auto values = raised(flat(20), 14, 20, 0.04);
    const double p = surest_p(values, 0.01);
    EXPECT_LT(p, step_p);
    EXPECT_THAT(steps(values, {0.01, 1}), Not(IsEmpty()));
    EXPECT_THAT(steps(values, {0.01, 2 * step_p / p}), IsEmpty());
}

TEST(steps, series_without_any_are_seldom_called_changed) {
    int alarmed = 0;
    for (unsigned seed = 0; seed < 200; ++seed)
        alarmed += surest_p(flat(30, seed), five_percent.least_shift) < step_p ? 1 : 0;
    EXPECT_LE(alarmed, 2);
}

}  // namespace
}  // namespace ptb
