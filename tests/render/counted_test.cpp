#include "tests/support/everything.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

TEST(Counted, counting_changes_no_bit_and_counts_the_films_segments) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        const RenderJob job = small_job(lanes);
        const auto plain = make_render(device, row.id, scene, job);
        const auto counting = make_render(device, row.id, scene, job, count_option);
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
