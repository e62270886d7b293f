#include "bench/measure/disturbance.h"
#include "tests/support/devices.h"

namespace ptb {
namespace {

TEST(ClockProbe, every_device_that_profiles_runs_it) {
    on_every_device([](const ocl::Device& device) {
        ClockProbe probe(device);
        const std::int64_t ns = probe.run();
        EXPECT_EQ(ns > 0, device.info.profiling);
        EXPECT_GE(probe.cost_s() * 1e9, static_cast<double>(ns));
    });
}

TEST(Disturbances, long_samples_carry_the_probes_time_and_short_ones_are_left_alone) {
    on_every_device([](const ocl::Device& device) {
        Disturbances disturbances(device);
        TimeSample sample;
        disturbances.begin(0.001);
        disturbances.end(sample);
        EXPECT_EQ(sample, TimeSample{});
        disturbances.begin(1000);
        disturbances.end(sample);
        EXPECT_GT(sample.probe_ns, 0);
    });
}

}  // namespace
}  // namespace ptb
