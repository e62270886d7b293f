#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/ocl/program.h"
#include "probe/fields.h"
#include "tests/support/devices.h"

namespace ptb {
namespace {

struct Fact {
    std::string what;
    std::uint32_t bytes;
    bool operator==(const Fact&) const = default;
};

/// Sizes and offsets as this compiler has them, in the order of the probe's answer.
std::vector<Fact> host_layout() {
#define PTB_SIZE(type) {"size of " #type, static_cast<std::uint32_t>(sizeof(type))},
#define PTB_OFFSET(type, field) {#type "." #field, static_cast<std::uint32_t>(offsetof(type, field))},
    return {PTB_SHARED_FIELDS(PTB_SIZE, PTB_OFFSET)};
}

std::vector<std::uint32_t> device_layout(const ocl::Device& device, std::size_t count) {
    const ocl::Program program = ocl::build(device, kernel_source("probe/layout.cl"), "-cl-std=CL1.2");
    cl::Kernel kernel(program.program, "probe_layout");
    const cl::Buffer out(device.context, CL_MEM_WRITE_ONLY, count * sizeof(std::uint32_t));
    kernel.setArg(0, out);
    device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1));
    std::vector<std::uint32_t> answer(count);
    device.queue.enqueueReadBuffer(out, CL_TRUE, 0, count * sizeof(std::uint32_t), answer.data());
    return answer;
}

TEST(Layout, shared_structs_lie_alike_on_host_and_device) {
    const std::vector<Fact> host = host_layout();
    on_every_device([&](const ocl::Device& device) {
        const std::vector<std::uint32_t> there = device_layout(device, host.size());
        for (std::size_t i = 0; i < host.size(); ++i)
            EXPECT_EQ(host[i].bytes, there[i]) << host[i].what << " differs: every upload would be misread";
    });
}

TEST(Layout, probe_lists_every_field) {
    // The structs have no hidden padding, so the sizes of the listed fields must add up.
    std::uint64_t listed = 0, whole = 0;
#define PTB_ADD_STRUCT(type) whole += sizeof(type);
#define PTB_ADD_FIELD(type, field) listed += sizeof(type::field);
    PTB_SHARED_FIELDS(PTB_ADD_STRUCT, PTB_ADD_FIELD)
    EXPECT_EQ(listed, whole) << "kernels/probe/fields.h lacks a field";
}

}  // namespace
}  // namespace ptb
