#include "core/integrator/registry.h"

#include <gtest/gtest.h>

#include "core/oracle/oracle.h"

namespace ptb {
namespace {

TEST(Registry, every_kernel_of_light_has_a_host_tracer_as_its_truth) {
    for (const Integrator& row : integrators())
        EXPECT_NE(tracers().contains(truth_of(row.id)), row.lists_rays) << row.id;
}

TEST(Registry, a_kernel_is_its_own_truth_where_its_row_names_none) {
    for (const Integrator& row : integrators())
        EXPECT_EQ(truth_of(row.id), row.truth.empty() ? row.id : row.truth);
    EXPECT_EQ(truth_of("of_another_version"), "of_another_version");
}

}  // namespace
}  // namespace ptb
