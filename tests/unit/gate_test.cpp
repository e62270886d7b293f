#include "bench/compare/gate.h"

#include <cmath>

#include <gtest/gtest.h>

namespace ptb {
namespace {

Round round_of(std::int64_t ns) { return {{ns + 90, ns, ns + 50}, {2 * ns, 2 * ns, 2 * ns}}; }

/// Blocks whose new side takes `ratio` times as long, give or take a deterministic 0.4 %.
std::vector<Block> blocks(int count, double ratio, std::int64_t base_ns = 1'000'000) {
    std::vector<Block> made;
    for (int i = 0; i < count; ++i) {
        const double wobble = 1 + 0.001 * (i * 7 % 9 - 4);
        const auto now_ns = static_cast<std::int64_t>(static_cast<double>(base_ns) * ratio * wobble);
        made.push_back({{round_of(base_ns), round_of(now_ns), round_of(now_ns), round_of(base_ns)}});
    }
    return made;
}

GateCase gate_case(double screened, double confirmed = 0) {
    GateCase c;
    c.timer = "event";
    c.screen = blocks(screen_blocks, screened);
    if (confirmed > 0) c.confirm = blocks(confirm_blocks, confirmed);
    return c;
}

State state(const std::vector<GateCase>& cases, std::size_t i = 0) { return decide(cases).at(i).state; }

TEST(gate, a_round_is_its_shortest_sample_and_a_linear_drift_cancels) {
    const Block drifting{{round_of(1000), round_of(1100), round_of(1210), round_of(1331)}};
    EXPECT_NEAR(differences(std::vector{drifting}, "event").at(0), 0, 1e-3);
    const Block slower{{round_of(1000), round_of(2000), round_of(2000), round_of(1000)}};
    EXPECT_DOUBLE_EQ(differences(std::vector{slower}, "event").at(0), std::log(2));
}

TEST(gate, the_host_clock_judges_where_it_is_the_timer) {
    Block block{{round_of(1000), round_of(1000), round_of(1000), round_of(1000)}};
    block.rounds[1].host_ns = block.rounds[2].host_ns = {4000, 4000, 4000};
    EXPECT_DOUBLE_EQ(differences(std::vector{block}, "event").at(0), 0);
    EXPECT_DOUBLE_EQ(differences(std::vector{block}, "host").at(0), std::log(2));
}

TEST(gate, suspects_are_significant_and_over_half_of_the_tolerance) {
    EXPECT_TRUE(suspect(gate_case(1.04)));
    EXPECT_TRUE(suspect(gate_case(0.96)));
    EXPECT_FALSE(suspect(gate_case(1.02))) << "significant, but too small to matter";
    EXPECT_FALSE(suspect(gate_case(1.0)));
    EXPECT_FALSE(suspect(GateCase()));
}

TEST(gate, each_state_is_reached) {
    EXPECT_EQ(state({gate_case(1.1, 1.1)}), State::regressed);
    EXPECT_EQ(state({gate_case(0.9, 0.9)}), State::improved);
    EXPECT_EQ(state({gate_case(1.0)}), State::same);
    EXPECT_EQ(state({gate_case(1.1, 1.0)}), State::same) << "the fresh blocks alone decide";
    EXPECT_EQ(state({gate_case(1.04, 1.049)}), State::inconclusive) << "over and under the tolerance";
    EXPECT_EQ(state({gate_case(1.1)}), State::inconclusive)
        << "suspects are not convicted without fresh blocks";
    GateCase gone;
    gone.without_times = State::missing;
    EXPECT_EQ(state({gone}), State::missing);
}

TEST(gate, the_tolerance_is_the_cases_own) {
    GateCase strict = gate_case(1.04, 1.04);
    EXPECT_EQ(state({strict}), State::same);
    strict.tolerance = 0.03;
    EXPECT_EQ(state({strict}), State::regressed);
}

TEST(gate, holm_counts_the_confirmed_cases_only) {
    const auto findings = decide(std::vector{gate_case(1.0), gate_case(1.1, 1.1), gate_case(1.2, 1.2)});
    EXPECT_DOUBLE_EQ(findings[0].evidence.holm_p, findings[0].evidence.p);
    EXPECT_DOUBLE_EQ(findings[1].evidence.holm_p, 2 * findings[1].evidence.p);
    EXPECT_EQ(findings[1].n, confirm_blocks);
    EXPECT_EQ(findings[0].n, screen_blocks);
}

TEST(gate, findings_carry_medians_ratio_and_smallest_effect) {
    const Finding finding = decide(std::vector{gate_case(1.1, 1.1)}).at(0);
    EXPECT_DOUBLE_EQ(finding.base_ns, 1'000'000);
    EXPECT_NEAR(finding.now_ns, 1'100'000, 1e3);
    EXPECT_NEAR(finding.evidence.ratio(), 1.1, 1e-3);
    EXPECT_GT(finding.smallest_effect, 0.05);
    EXPECT_LT(finding.smallest_effect, 0.06);
}

}  // namespace
}  // namespace ptb
