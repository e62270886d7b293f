#include "bench/cli/exit_code.h"

#include <array>

#include <gtest/gtest.h>

namespace ptb {
namespace {

std::vector<Record> records(const std::vector<Status>& statuses) {
    std::vector<Record> made(statuses.size());
    for (std::size_t i = 0; i < made.size(); ++i) made[i].status = statuses[i];
    return made;
}

/// Each reason to end with a code, alone, from the first in rank to the last.
const std::array<std::pair<bool Outcome::*, int>, 8> by_rank{{{&Outcome::interrupted, 130},
                                                              {&Outcome::no_device, 77},
                                                              {&Outcome::failed, 1},
                                                              {&Outcome::wrong_image, 4},
                                                              {&Outcome::not_comparable, 7},
                                                              {&Outcome::coverage_lost, 6},
                                                              {&Outcome::regressed, 3},
                                                              {&Outcome::inconclusive, 5}}};

TEST(exit_code, of_each_status) {
    const std::vector<std::pair<Status, int>> table{
        {Status::ok, 0},      {Status::invalid, 4}, {Status::unsupported, 0},
        {Status::skipped, 0}, {Status::compile, 1}, {Status::runtime, 1},
        {Status::timeout, 1}, {Status::crash, 1},   {Status::unstable, 0}};
    for (const auto& [status, code] : table)
        for (const auto& all : {std::vector{Status::ok, status}, std::vector{status, Status::ok}})
            EXPECT_EQ(exit_code(outcome_of(records(all))), code) << "status " << static_cast<int>(status);
}

TEST(exit_code, of_every_set_of_reasons_is_that_of_the_first_in_rank) {
    for (unsigned set = 0; set < 1u << by_rank.size(); ++set) {
        Outcome outcome;
        int code = 0;
        for (std::size_t i = by_rank.size(); i-- > 0;) {
            if ((set >> i & 1u) == 0) continue;
            outcome.*by_rank[i].first = true;
            code = by_rank[i].second;
        }
        EXPECT_EQ(exit_code(outcome), code) << "set of reasons " << set;
    }
}

TEST(exit_code, is_never_a_count) {
    const std::vector<std::pair<Status, int>> table{{Status::crash, 1}, {Status::invalid, 4}};
    for (const auto& [status, code] : table)
        for (const std::size_t n : {2u, 255u, 256u, 257u, 512u})
            EXPECT_EQ(exit_code(outcome_of(records(std::vector(n, status)))), code) << n;
}

TEST(exit_code, of_many_kinds_of_records_is_that_of_the_worst) {
    EXPECT_EQ(exit_code(outcome_of(records({Status::invalid, Status::crash, Status::ok}))), 1);
    EXPECT_EQ(exit_code(outcome_of({})), 0);
}

TEST(exit_code, of_256_regressions_is_3) {
    Outcome outcome = outcome_of(records(std::vector(256, Status::ok)));
    for (int i = 0; i < 256; ++i) outcome |= Outcome{.regressed = true};
    EXPECT_EQ(exit_code(outcome), 3);
    outcome |= outcome_of(records({Status::invalid}));
    EXPECT_EQ(exit_code(outcome), 4);
}

}  // namespace
}  // namespace ptb
