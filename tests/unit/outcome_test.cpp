#include "bench/workbench/outcome.h"

#include <new>

#include <gtest/gtest.h>

#include "core/ocl/error.h"
#include "core/source/source.h"

namespace ptb {
namespace {

/// A case that was built, validated and timed.
Record measured() {
    Record record;
    record.work = Work{};
    record.work->samples = 512;
    record.work->longest_launch_ns = 9;
    record.build = Build{};
    record.build->options = "-DPTB_LANES=8";
    record.build->first_launch_ns = 5;
    record.samples = {TimeSample{}};
    record.statistics = Statistics{};
    record.energy = Energy{};
    record.counted = Counted{};
    record.validation = Validation{};
    record.validation->valid = true;
    return record;
}

template <class Error>
Record ended_by(const Error& error) {
    Record record = measured();
    conclude_attempt(record, [&] { throw error; });
    return record;
}

TEST(Outcome, what_is_thrown_becomes_status_and_reason) {
    const auto expect = [](const Record& record, Status status, const std::string& reason) {
        EXPECT_EQ(record.status, status);
        EXPECT_EQ(record.reason, reason);
    };
    expect(ended_by(Unsupported("lanes 4: thesis has 1")), Status::unsupported, "lanes 4: thesis has 1");
    expect(ended_by(ocl::BuildError("it does not compile", "pt.cl:3: mistake")), Status::compile,
           "it does not compile");
    expect(ended_by(SourceError("pt.cl:1: no file nowhere.h")), Status::compile,
           "pt.cl:1: no file nowhere.h");
    const ocl::Error lost("clFinish", -2, "GPU");
    expect(ended_by(lost), Status::runtime, lost.what());
    expect(ended_by(std::bad_alloc()), Status::runtime, std::bad_alloc().what());
}

TEST(Outcome, an_attempt_that_throws_nothing_ends_as_it_says) {
    Record record;
    conclude_attempt(record, [&] { conclude(record, Status::unstable, "busy"); });
    EXPECT_EQ(record.status, Status::unstable);
    EXPECT_EQ(record.reason, "busy");
}

TEST(Outcome, a_compiler_log_is_kept_with_the_build) {
    const Record record = ended_by(ocl::BuildError("it does not compile", "pt.cl:3: mistake"));
    EXPECT_EQ(record.build->log, "pt.cl:3: mistake");
    EXPECT_EQ(record.build->options, "-DPTB_LANES=8");
}

TEST(Outcome, only_kernels_from_elsewhere_lack_a_file) {
    EXPECT_TRUE(ended_by(SourceError("nowhere.h")).build->overridden);
}

TEST(Outcome, a_case_without_a_valid_time_keeps_no_part_of_one) {
    Record record = measured();
    conclude(record, Status::invalid, "wrong");
    EXPECT_TRUE(record.samples.empty());
    EXPECT_FALSE(record.statistics || record.energy || record.counted);
    EXPECT_EQ(record.work->longest_launch_ns, 0);
    EXPECT_EQ(record.build->first_launch_ns, 0);
    EXPECT_EQ(record.work->samples, 512U) << "the work is known";
    EXPECT_TRUE(record.validation);
}

TEST(Outcome, unstable_times_are_kept) {
    Record record = measured();
    conclude(record, Status::unstable, "busy");
    conclude_by_image(record);
    EXPECT_EQ(record.status, Status::unstable);
    EXPECT_EQ(record.reason, "busy");
    EXPECT_TRUE(record.statistics);
    EXPECT_EQ(record.samples.size(), 1U);
}

TEST(Outcome, a_wrong_image_ends_even_an_unstable_case) {
    Record record = measured();
    conclude(record, Status::unstable, "busy");
    record.validation->valid = false;
    record.validation->reason = "nan at column 0, row 0";
    conclude_by_image(record);
    EXPECT_EQ(record.status, Status::invalid);
    EXPECT_EQ(record.reason, "nan at column 0, row 0");
    EXPECT_FALSE(record.statistics);
}

TEST(Outcome, a_right_image_is_ok) {
    Record record = measured();
    conclude_by_image(record);
    EXPECT_EQ(record.status, Status::ok);
    EXPECT_EQ(record.reason, "");
}

}  // namespace
}  // namespace ptb
