#include <string>

#include <gmock/gmock.h>

#include "core/integrator/registry.h"
#include "tests/support/devices.h"

namespace ptb {
namespace {

Scene shipped(const std::string& name) {
    return load_scene(std::filesystem::path(PTB_SOURCE_DIR) / "configs/scenes" / (name + ".json"));
}

TEST(Build, every_integrator_compiles_for_every_lane_width_without_warnings) {
    const Scene scene = shipped("thesis");
    on_every_compiler([&](const ocl::Device& device) {
        for (const Integrator& row : integrators()) {
            if (!row.spheres) continue;
            for (const int lanes : row.lanes) {
                SCOPED_TRACE(row.id + ", lanes " + std::to_string(lanes));
                RenderJob job;
                job.lanes = lanes;
                const ocl::Program program =
                    ocl::build(device, kernel_source(row.file()), row.options(device, scene, job));
                EXPECT_THAT(program.log, testing::Not(testing::HasSubstr("warning:")));
                EXPECT_EQ(program.kernel_hash, kernel_source(row.file()).hash);
                EXPECT_FALSE(program.overridden);
            }
        }
    });
}

TEST(Build, kernel_facts_are_those_of_a_usable_kernel) {
    const Scene scene = shipped("thesis");
    on_every_compiler([&](const ocl::Device& device) {
        for (const Integrator& row : integrators()) {
            if (!row.spheres) continue;
            RenderJob job;
            job.size = {8, 8};
            const ocl::Program program =
                ocl::build(device, kernel_source(row.file()), row.options(device, scene, job));
            const auto render = row.make(device, program, scene, job);
            EXPECT_GE(render->facts().max_work_group, 1u) << row.id;
            EXPECT_LE(render->facts().max_work_group, device.info.max_work_group) << row.id;
            EXPECT_GE(render->facts().preferred_multiple, 1u) << row.id;
            EXPECT_GE(render->device_bytes(), 64u * 16u) << row.id << " has a film";
        }
    });
}

TEST(Build, memory_foretold_covers_what_is_asked_for) {
    const Scene scene = shipped("thesis");
    on_every_compiler([&](const ocl::Device& device) {
        for (const Integrator& row : integrators()) {
            if (!row.spheres) continue;
            RenderJob job;
            job.size = {64, 32};
            const ocl::Program program =
                ocl::build(device, kernel_source(row.file()), row.options(device, scene, job));
            const auto render = row.make(device, program, scene, job);
            EXPECT_EQ(row.memory(device, scene, job).total, render->device_bytes()) << row.id;
        }
    });
}

}  // namespace
}  // namespace ptb
