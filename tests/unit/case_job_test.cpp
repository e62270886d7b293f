#include "bench/workbench/case_job.h"

#include <gtest/gtest.h>

namespace ptb {
namespace {

CaseJob job_of(const Case& params, const Scene& scene = {}) {
    DeviceInfo device;
    device.default_lanes = 16;
    const Integrator& kernel = integrator(params.kernel);
    return {params, nullptr, &kernel, render_job(params, kernel, device, scene, 7)};
}

Case pt_case() { return {"pocl:0", "pt", "thesis", {640, 480}, 10, 5, {64, 0}, 0}; }

TEST(CaseJob, the_device_decides_lanes_that_the_case_leaves_open) {
    Case params = pt_case();
    EXPECT_EQ(job_of(params).work.lanes, 16);
    params.lanes = 4;
    EXPECT_EQ(job_of(params).work.lanes, 4);
    params = {"pocl:0", "thesis", "thesis", {1, 1}, 1, 5, {}, 0};
    EXPECT_EQ(job_of(params).work.lanes, 1) << "thesis has no other width";
}

TEST(CaseJob, the_work_is_what_the_case_asks_for) {
    const RenderJob work = job_of(pt_case()).work;
    EXPECT_EQ(work.size, (Size{640, 480}));
    EXPECT_EQ(work.spp, 10);
    EXPECT_EQ(work.path_length, 5);
    EXPECT_EQ(work.seed, 7U);
    EXPECT_EQ(work.work_group_x, 64);
    EXPECT_EQ(work.work_group_y, 0);
}

TEST(CaseJob, cases_share_a_key_whatever_their_size_spp_and_work_group) {
    Case other = pt_case();
    other.size = {16, 16};
    other.spp = 1000;
    other.work_group = {8, 8};
    other.lanes = 16;
    EXPECT_EQ(job_of(other).key(), job_of(pt_case()).key());
}

TEST(CaseJob, whatever_a_sample_costs_or_shows_has_a_key_of_its_own) {
    const std::string key = job_of(pt_case()).key();
    const auto changed = [](auto change) {
        Case params = pt_case();
        change(params);
        return job_of(params).key();
    };
    EXPECT_NE(changed([](Case& c) { c.kernel = "direct"; }), key);
    EXPECT_NE(changed([](Case& c) { c.scene = "free_light"; }), key);
    EXPECT_NE(changed([](Case& c) { c.lanes = 8; }), key);
    EXPECT_NE(changed([](Case& c) { c.path_length = 6; }), key);
    for (const VariantAxis& axis : variant_axes())
        EXPECT_NE(changed([&](Case& c) { axis.set(c.variant, 1); }), key) << axis.name;
}

TEST(CaseJob, launches_of_the_same_image_are_plainly_the_same) {
    Case params = pt_case();
    params.variant.queue = QueueOrder::out_of_order;
    params.variant.dispatch = Dispatch::tasks;
    params.variant.film_memory = FilmMemory::image;
    const CaseJob plain = job_of(params).plain();
    EXPECT_EQ(plain.key(), job_of(pt_case()).plain().key());
    EXPECT_EQ(plain.work.work_group_x, 0);
    params.variant.roulette = Roulette::albedo;
    EXPECT_NE(job_of(params).plain().key(), plain.key()) << "another image";
}

TEST(CaseJob, a_job_without_a_work_group_is_launched_as_it_was) {
    Case params = pt_case();
    params.variant.queue = QueueOrder::out_of_order;
    const CaseJob implicit = job_of(params).implicit();
    EXPECT_EQ(implicit.work.work_group_x, 0);
    EXPECT_EQ(implicit.work.variant, params.variant);
    EXPECT_EQ(implicit.sized({2, 3}, 4).work.size, (Size{2, 3}));
    EXPECT_EQ(implicit.sized({2, 3}, 4).work.spp, 4);
}

}  // namespace
}  // namespace ptb
