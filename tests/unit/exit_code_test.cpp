#include "bench/cli/exit_code.h"

#include <gtest/gtest.h>

namespace ptb {
namespace {

Record record(Status status) {
    Record made;
    made.status = status;
    return made;
}

TEST(exit_code, of_each_status) {
    const std::vector<std::pair<Status, int>> table{
        {Status::ok, 0},      {Status::invalid, 4}, {Status::unsupported, 0},
        {Status::skipped, 0}, {Status::compile, 1}, {Status::runtime, 1},
        {Status::timeout, 1}, {Status::crash, 1},   {Status::unstable, 0}};
    for (const auto& [status, code] : table) {
        EXPECT_EQ(exit_code(outcome_of({record(Status::ok), record(status)})), code)
            << "status number " << static_cast<int>(status);
    }
}

TEST(exit_code, a_failure_outranks_a_wrong_image) {
    EXPECT_EQ(exit_code(outcome_of({record(Status::invalid), record(Status::crash)})), 1);
}

TEST(exit_code, each_reason_outranks_those_after_it) {
    const std::vector<std::pair<bool Outcome::*, int>> by_rank{
        {&Outcome::interrupted, 130}, {&Outcome::no_device, 77},     {&Outcome::failed, 1},
        {&Outcome::wrong_image, 4},   {&Outcome::not_comparable, 7}, {&Outcome::coverage_lost, 6},
        {&Outcome::regressed, 3},     {&Outcome::inconclusive, 5}};
    Outcome all;
    for (const auto& [flag, code] : by_rank) all.*flag = true;
    for (const auto& [flag, code] : by_rank) {
        EXPECT_EQ(exit_code(all), code);
        all.*flag = false;
    }
    EXPECT_EQ(exit_code(all), 0);
}

}  // namespace
}  // namespace ptb
