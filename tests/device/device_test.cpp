#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "tests/support/devices.h"

namespace ptb {
namespace {

TEST(Devices, facts_are_sane) {
    on_every_device([](const ocl::Device& device) {
        const DeviceInfo& info = device.info;
        EXPECT_FALSE(info.name.empty());
        EXPECT_FALSE(info.vendor.empty());
        EXPECT_FALSE(info.platform.empty());
        EXPECT_THAT((std::set<std::string>{"CPU", "GPU", "accelerator", "other"}),
                    testing::Contains(info.type));
        EXPECT_THAT(info.version, testing::StartsWith("OpenCL "));
        EXPECT_THAT(info.c_version, testing::StartsWith("OpenCL C "));
        EXPECT_GE(info.compute_units, 1);
        EXPECT_GE(info.global_bytes, info.max_alloc_bytes);
        EXPECT_GE(info.max_alloc_bytes, 128u << 20) << "OpenCL 1.2 promises 128 MiB";
        EXPECT_GE(info.constant_bytes, 64u << 10) << "OpenCL 1.2 promises 64 KiB";
        EXPECT_GE(info.max_work_group, 1u);
        EXPECT_GE(info.max_work_item_sizes.size(), 3u);
        EXPECT_TRUE(info.profiling) << "OpenCL 1.2 promises profiling queues";
        EXPECT_THAT((std::set<int>{1, 4, 8, 16, 32}), testing::Contains(info.default_lanes));
        EXPECT_LE(info.default_lanes, 2 * std::max(info.native_float_width, 1));
    });
}

TEST(Devices, keys_are_unique_and_open_what_they_name) {
    std::set<std::string> keys;
    for (const DeviceInfo& info : ocl::query_devices()) {
        EXPECT_TRUE(keys.insert(info.key).second) << info.key << " twice";
        EXPECT_EQ(ocl::open_device(info.key).info, info);
    }
}

TEST(Devices, pthread_and_basic_stay_two_devices) {
    const char* const asked = std::getenv("POCL_DEVICES");
    if (asked == nullptr || std::string(asked) != "pthread basic")
        GTEST_SKIP() << "POCL_DEVICES is not \"pthread basic\"";
    std::set<std::string> keys;
    for (const DeviceInfo& info : ocl::query_devices()) keys.insert(info.key);
    EXPECT_THAT(keys, testing::IsSupersetOf({"pocl:0", "pocl:1"}));
}

TEST(Devices, only_llvmpipe_bounds_loops) {
    DeviceInfo info;
    info.name = "NVIDIA H200";
    EXPECT_GT(ocl::loop_limit(info), 1ull << 60);
    info.name = "llvmpipe (LLVM 15.0.6, 256 bits)";
    EXPECT_EQ(ocl::loop_limit(info), 65535u);
}

}  // namespace
}  // namespace ptb
