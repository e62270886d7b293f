#include <cmath>
#include <string>

#include <fmt/format.h>

#include "tests/support/everything.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

/// (1 - a^length) / (1 - a): what a closed room of albedo a and radiance 1 sends into every ray.
double furnace_radiance(double albedo, int length) { return (1 - std::pow(albedo, length)) / (1 - albedo); }

TEST(Counts, every_sample_of_odd_sizes_is_done_once) {
    const Scene scene = shipped_scene("thesis");
    on_every_device([&](const ocl::Device& device) {
        for (const int lanes : integrator("pt").lanes) {
            for (const int spp : {1, 7, 33}) {
                RenderJob job;
                job.size = {37, 21};
                job.spp = spp;
                job.path_length = 4;
                job.lanes = lanes;
                SCOPED_TRACE(fmt::format("lanes {}, spp {}", lanes, spp));
                const auto render = make_render(device, "pt", scene, job);
                const auto asked = static_cast<std::uint64_t>(37 * 21 * spp);
                EXPECT_EQ(render->samples_left(), asked);
                const Film film = finish(*render);
                EXPECT_EQ(film.samples, asked);
                EXPECT_GE(film.segments, asked);
                EXPECT_LE(film.segments, 4 * asked);
                EXPECT_LE(film.full_length_paths.value_or(asked + 1), asked);
            }
        }
    });
}

TEST(Counts, samples_left_falls_to_zero_by_what_was_asked) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        const auto render = make_render(device, row.id, scene, small_job(lanes));
        std::uint64_t left = render->samples_left();
        while (left > 0) {
            render->advance(1000);
            ASSERT_LT(render->samples_left(), left) << "makes no progress";
            EXPECT_LE(left - render->samples_left(), 1000u) << "does more than it may in one launch";
            left = render->samples_left();
        }
    });
}

TEST(Counts, path_length_one_sees_only_what_shines) {
    const Scene scene = shipped_scene("furnace");
    on_every_device([&](const ocl::Device& device) {
        RenderJob job;
        job.size = {37, 21};
        job.spp = 3;
        job.path_length = 1;
        const Film film = render_film(device, "pt", scene, job);
        EXPECT_EQ(film.segments, film.samples);
        EXPECT_EQ(film.full_length_paths, film.samples);
        for (const float value : film.mean.rgb) ASSERT_NEAR(value, 1.0, 1e-6);
    });
}

class Furnace : public testing::TestWithParam<int> {};

TEST_P(Furnace, every_pixel_has_the_geometric_series) {
    const int length = GetParam();
    const Scene scene = shipped_scene("furnace");
    const double albedo[3] = {0.5, 0.7, 0.9};
    on_every_device([&](const ocl::Device& device) {
        for (const int lanes : integrator("pt").lanes) {
            SCOPED_TRACE(fmt::format("lanes {}", lanes));
            RenderJob job;
            job.size = {32, 32};
            job.spp = 33;
            job.path_length = length;
            job.lanes = lanes;
            const Film film = render_film(device, "pt", scene, job);
            EXPECT_EQ(film.segments, *film.samples * static_cast<std::uint64_t>(length));
            EXPECT_EQ(film.full_length_paths, film.samples);
            for (std::size_t i = 0; i < film.mean.rgb.size(); ++i) {
                const double expected = furnace_radiance(albedo[i % 3], length);
                ASSERT_NEAR(film.mean.rgb[i], expected, 1e-4 * expected) << "pixel " << i / 3;
                ASSERT_LE(film.variance->rgb[i], 1e-5 * expected * expected) << "every sample is the same";
            }
        }
    });
}

INSTANTIATE_TEST_SUITE_P(path_length, Furnace, testing::Values(1, 2, 5, 64),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace ptb
