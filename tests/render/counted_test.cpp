#include <fmt/format.h>

#include "tests/support/devices.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

/// Calls with each device, kernel and lane width.
template <class Check>
void on_every_build(const Check& check) {
    on_every_device([&](const ocl::Device& device) {
        for (const Integrator& row : integrators()) {
            if (!row.spheres) continue;
            for (const int lanes : row.lanes) {
                SCOPED_TRACE(fmt::format("{}, lanes {}", row.id, lanes));
                RenderJob job;
                job.size = {37, 21};
                job.spp = 5;
                job.path_length = 16;
                job.lanes = lanes;
                check(device, row.id, job);
            }
        }
    });
}

TEST(Counted, counting_changes_no_bit_and_counts_the_films_segments) {
    const Scene scene = shipped_scene("thesis");
    on_every_build([&](const ocl::Device& device, const std::string& kernel, const RenderJob& job) {
        const auto plain = make_render(device, kernel, scene, job);
        const auto counting = make_render(device, kernel, scene, job, count_option);
        const Film film = finish(*counting, 1000);
        EXPECT_EQ(film.mean.rgb, finish(*plain).mean.rgb);
        EXPECT_EQ(plain->counts(), std::nullopt);
        const Counts counts = counting->counts().value();
        EXPECT_EQ(counts.segments, film.segments);
        EXPECT_EQ(counts.lanes % static_cast<std::uint64_t>(job.lanes), 0u);
        if (job.lanes > 1) {
            EXPECT_GE(counts.lanes, counts.segments);
        }
        EXPECT_GT(counts.flops, 0u);
        counting->restart();
        EXPECT_EQ(counting->counts(), Counts()) << "of an empty film";
    });
}

}  // namespace
}  // namespace ptb
