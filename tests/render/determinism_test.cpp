#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/support/everything.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

bool same_bits(const Image& a, const Image& b) {
    return a.rgb.size() == b.rgb.size() &&
           std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)) == 0;
}

/// Mean, variance and counts, bit by bit.
void expect_same(const Film& film, const Film& other) {
    EXPECT_TRUE(same_bits(film.mean, other.mean));
    EXPECT_EQ(film.variance.has_value(), other.variance.has_value());
    if (film.variance && other.variance) {
        EXPECT_TRUE(same_bits(*film.variance, *other.variance));
    }
    EXPECT_EQ(film.samples, other.samples);
    EXPECT_EQ(film.segments, other.segments);
    EXPECT_EQ(film.full_length_paths, other.full_length_paths);
    EXPECT_EQ(film.shadow_rays, other.shadow_rays);
    EXPECT_EQ(film.light_segments, other.light_segments);
}

TEST(Determinism, work_group_changes_no_bit) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        const Film implicit = render_film(device, row.id, scene, small_job(lanes));
        std::vector<std::pair<int, int>> groups{{7, 0}, {64, 0}};
        if (row.id == "pt") groups.emplace_back(1, 0);
        if (row.two_dimensional) groups.insert(groups.end(), {{16, 16}, {5, 3}, {64, 1}});
        for (const auto& [x, y] : groups) {
            SCOPED_TRACE(fmt::format("work-group {}x{}", x, y));
            RenderJob job = small_job(lanes);
            job.work_group_x = x;
            job.work_group_y = y;
            expect_same(render_film(device, row.id, scene, job), implicit);
        }
    });
}

TEST(Determinism, cut_into_passes_changes_no_bit) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        const auto render = make_render(device, row.id, scene, small_job(lanes));
        const Film at_once = finish(*render);
        for (const std::uint64_t samples : {100u, 1000u, 2500u}) {
            SCOPED_TRACE(fmt::format("{} samples a pass", samples));
            render->restart();
            expect_same(finish(*render, samples), at_once);
        }
    });
}

TEST(Determinism, smallest_passes_change_no_bit) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        RenderJob job = small_job(lanes);
        job.size = {9, 5};
        job.spp = 3;
        for (const int work_group_y : {0, row.two_dimensional ? 4 : 0}) {
            job.work_group_x = work_group_y == 0 ? 0 : 4;
            job.work_group_y = work_group_y;
            const auto render = make_render(device, row.id, scene, job);
            const Film at_once = finish(*render);
            render->restart();
            expect_same(finish(*render, 1), at_once);
        }
    });
}

TEST(Determinism, restart_and_repetition_change_no_bit) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        const auto render = make_render(device, row.id, scene, small_job(lanes));
        const Film first = finish(*render);
        render->restart();
        expect_same(finish(*render), first);
        render->restart();
        render->advance(500);  // left in the middle
        render->restart();
        expect_same(finish(*render), first);
        expect_same(render_film(device, row.id, scene, small_job(lanes)), first);
    });
}

TEST(Determinism, restart_empties_the_film) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        const auto render = make_render(device, row.id, scene, small_job(lanes));
        finish(*render);
        render->restart();
        const Film film = render->read_film();
        EXPECT_EQ(film.segments, 0u);
        for (const float value : film.mean.rgb) ASSERT_EQ(value, 0.0f);
    });
}

TEST(Determinism, seed_changes_the_picture) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        RenderJob job = small_job(lanes);
        const Film first = render_film(device, row.id, scene, job);
        job.seed = 2;
        EXPECT_FALSE(same_bits(render_film(device, row.id, scene, job).mean, first.mean));
    });
}

/// The film of some parts of an image, cut into runs as another device was.
FilmSums sums_of_parts(const ocl::Device& device, const Integrator& row, const Scene& scene, RenderJob job,
                       RunCut cut, std::vector<PartRange> ranges) {
    job.cut = cut;
    const ocl::Program program =
        ocl::build(device, kernel_source(row.file()), row.options(device, scene, job));
    const auto render = row.make_parts(device, program, scene, job);
    for (const PartRange& range : ranges) {
        render->take(range);
        while (render->samples_left() > 0) render->advance(whole);
    }
    FilmSums sums{{}, std::vector<FilmPixel>(job.size.pixels())};
    sums.facts = render->read_sums(sums.pixels);
    return sums;
}

TEST(Determinism, parts_of_an_image_add_up_to_it_in_any_order) {
    const Scene scene = shipped_scene("thesis");
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        if (!row.has_parts()) return;
        RenderJob job = small_job(lanes);
        const RunCut cut{2, 3};
        job.cut = cut;
        const Film alone = render_film(device, row.id, scene, job);
        const std::uint64_t all = 3 * job.size.pixels();  // rounds of three samples at most
        FilmSums sums = sums_of_parts(device, row, scene, job, cut, {{1000, 1700}, {100, 200}});
        add_sums(sums, sums_of_parts(device, row, scene, job, cut, {{1700, all}, {0, 100}, {200, 1000}}));
        const Film together = film_of(sums);
        expect_same(together, alone);
        EXPECT_EQ(together.hash, alone.hash);
    });
}

/// Renders the scene for each value of an axis that `row` takes, and compares with the first one's film.
/// Returns how many there were beside the first.
int expect_same_along(const std::string& axis_name, const ocl::Device& device, const Integrator& row,
                      const Scene& scene, const RenderJob& job) {
    const auto& axes = variant_axes();
    const auto axis =
        std::find_if(axes.begin(), axes.end(), [&](const auto& a) { return a.name == axis_name; });
    const Film usual = render_film(device, row.id, scene, job);
    int compared = 0;
    for (std::size_t value = 1; value < axis->values.size(); ++value) {
        RenderJob changed = job;
        axis->set(changed.variant, value);
        if (!unsupported_reason(row, device, scene, changed).empty()) continue;
        SCOPED_TRACE(axis_name + " " + axis->values[value]);
        const auto render = make_render(device, row.id, scene, changed);
        expect_same(finish(*render), usual);
        render->restart();
        expect_same(finish(*render, 300), usual);
        ++compared;
    }
    return compared;
}

TEST(Determinism, queues_tasks_and_the_film_s_place_change_no_bit) {
    const Scene scene = shipped_scene("thesis");
    std::map<std::string, int> compared;
    on_everything([&](const ocl::Device& device, const Integrator& row, int lanes) {
        for (const char* axis : {"queue", "dispatch", "film_memory"})
            compared[axis] += expect_same_along(axis, device, row, scene, small_job(lanes));
        RenderJob both = small_job(lanes);
        both.variant.queue = QueueOrder::out_of_order;
        expect_same_along("dispatch", device, row, scene, both);
    });
    for (const auto& [axis, count] : compared) EXPECT_GT(count, 0) << axis << " was tried on no device";
}

TEST(Determinism, where_the_scene_lies_changes_no_bit) {
    on_every_device([&](const ocl::Device& device) {
        const Integrator pt = integrator("pt");
        for (const int lanes : {1, 8}) {
            SCOPED_TRACE(fmt::format("lanes {}", lanes));
            EXPECT_EQ(
                expect_same_along("scene_memory", device, pt, shipped_scene("thesis"), small_job(lanes)), 5);
        }
        EXPECT_EQ(expect_same_along("scene_memory", device, pt, mixed_balls(20), small_job(1)), 3);
    });
}

}  // namespace
}  // namespace ptb
