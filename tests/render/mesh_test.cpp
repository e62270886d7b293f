#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/oracle/oracle.h"
#include "tests/support/devices.h"
#include "tests/support/image_check.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

RenderJob small_job(int path_length, int spp) {
    RenderJob job;
    job.size = {32, 32};
    job.spp = spp;
    job.path_length = path_length;
    return job;
}

/// Runs `body(device, job)` for these layouts of trees on every device.
template <class Body>
void on_layouts(const std::vector<Bvh>& layouts, RenderJob job, Body&& body) {
    on_every_device([&](const ocl::Device& device) {
        for (const Bvh layout : layouts) {
            job.variant.bvh = layout;
            SCOPED_TRACE(to_string(job.variant));
            body(device, job);
        }
    });
}

template <class Body>
void on_every_layout(const RenderJob& job, Body&& body) {
    on_layouts({Bvh::bvh2, Bvh::bvh2q, Bvh::wide8}, job, body);
}

/// All of `pt`'s, whose search others share; of those the device's own.
std::vector<Bvh> layouts_to_try(const Integrator& row) {
    if (row.id == "pt") return {Bvh::bvh2, Bvh::bvh2q, Bvh::wide8};
    return {Bvh::automatic};
}

double segments_per_sample(const Film& film) {
    return static_cast<double>(film.segments) / static_cast<double>(*film.samples);
}

/// Every integrator that sees meshes, against the host's tracer.
TEST(Meshes, pictures_agree_with_the_hosts_tracers) {
    const Scene scene = mesh_room();
    const RenderJob job = small_job(5, 64);
    OracleJob asked{job.size, job.spp, job.path_length, 99, 2, false, {}};
    std::map<std::string, Reference> truths;
    for (const Integrator& row : integrators()) {
        if (!row.meshes || row.lists_rays) continue;
        SCOPED_TRACE(row.id);
        const std::string truth = truth_of(row.id);
        if (!truths.contains(truth))
            truths.emplace(truth, reference_of(tracers().at(truth)(scene, asked), scene, truth, asked));
        on_layouts(layouts_to_try(row), job, [&](const ocl::Device& device, const RenderJob& each) {
            const Film film = render_film(device, row.id, scene, each);
            EXPECT_TRUE(agrees(fmt::format("mesh_room_{}_{}", row.id, device.info.device_index), film, each,
                               truths.at(truth)));
        });
    }
}

/// Breaks when a ray slips between triangles, or meets from behind the one that it leaves or its neighbour.
TEST(Meshes, no_path_leaves_a_closed_room_of_needles) {
    const Scene scene = needle_room(200);
    const RenderJob job = small_job(32, 4);
    on_every_layout(job, [&](const ocl::Device& device, const RenderJob& each) {
        const Film film = render_film(device, "pt", scene, each);
        EXPECT_NEAR(segments_per_sample(film), each.path_length, 0.002 * each.path_length);
        const double expected = (1 - std::pow(0.5, each.path_length)) / (1 - 0.5);
        for (std::size_t i = 0; i < film.mean.rgb.size(); i += 3)
            ASSERT_NEAR(film.mean.rgb[i], expected, 0.02 * expected);
    });
}

TEST(Meshes, one_triangle_is_seen_from_both_sides_and_not_along_its_plane) {
    Scene scene = lone_triangle();
    const RenderJob job = small_job(3, 4);
    const auto brightest = [&](const ocl::Device& device, const RenderJob& each) {
        const Film film = render_film(device, "pt", scene, each);
        for (const float value : film.mean.rgb) EXPECT_FALSE(std::isnan(value));
        return *std::max_element(film.mean.rgb.begin(), film.mean.rgb.end());
    };
    on_every_layout(job, [&](const ocl::Device& device, const RenderJob& each) {
        for (const double side : {-5.0, 5.0}) {
            scene.camera.position = {0, 0, side};
            EXPECT_EQ(brightest(device, each), 3.0f);
        }
        scene.camera.position = {5, 0, 0};
        EXPECT_EQ(brightest(device, each), 0.0f);
    });
}

/// Far from the file's origin for its size, or in another unit: the camera is inside.
TEST(Meshes, pictures_do_not_depend_on_where_a_scene_is_nor_on_its_unit) {
    const RenderJob job = small_job(4, 16);
    on_every_layout(job, [&](const ocl::Device& device, const RenderJob& each) {
        const Film usual = render_film(device, "pt", mesh_room(), each);
        for (const auto& [scale, by] :
             {std::pair<double, Vec3>{1, {1e5, -1e5, 3e4}}, {1e-6, {}}, {1e6, {}}}) {
            SCOPED_TRACE(fmt::format("scale {:g}, moved by {:g}", scale, by.x));
            const Film other = render_film(device, "pt", moved(mesh_room(), scale, by), each);
            EXPECT_NEAR(segments_per_sample(other), segments_per_sample(usual), 0.002);
        }
    });
}

TEST(Meshes, work_groups_passes_and_queues_change_no_bit) {
    const Scene scene = mesh_room();
    RenderJob job = small_job(6, 5);
    job.size = {23, 17};
    for (const Integrator& row : integrators()) {
        if (!row.meshes) continue;
        SCOPED_TRACE(row.id);
        on_layouts(layouts_to_try(row), job, [&](const ocl::Device& device, const RenderJob& each) {
            const auto render = make_render(device, row.id, scene, each);
            const Film film = finish(*render);
            const auto expect_same = [&](const Film& other) {
                EXPECT_EQ(film.mean.rgb, other.mean.rgb);
                EXPECT_EQ(film.segments, other.segments);
                EXPECT_EQ(film.shadow_rays, other.shadow_rays);
            };
            render->restart();
            expect_same(finish(*render, 100));
            RenderJob changed = each;
            changed.work_group_x = 7;
            changed.variant.queue = QueueOrder::out_of_order;
            if (unsupported_reason(row, device, scene, changed).empty())
                expect_same(render_film(device, row.id, scene, changed));
        });
    }
}

TEST(Meshes, a_picture_of_costs_adds_up_to_what_is_counted) {
    RenderJob job = small_job(5, 3);
    job.aov = Aov::cost;
    const auto sum = [&](const Film& film, std::size_t channel) {
        double of_samples = 0;
        for (std::size_t i = channel; i < film.mean.rgb.size(); i += 3)
            of_samples += std::round(static_cast<double>(film.mean.rgb[i]) * job.spp);
        return of_samples;
    };
    on_every_layout(job, [&](const ocl::Device& device, const RenderJob& each) {
        const auto render = make_render(device, "pt_nee", mesh_room(), each);
        const Film film = finish(*render, 500);
        const Counts counts = render->counts().value();
        EXPECT_GT(counts.nodes, counts.searches);
        EXPECT_EQ(sum(film, 0), static_cast<double>(counts.nodes));
        EXPECT_EQ(sum(film, 1), static_cast<double>(counts.triangles));
        EXPECT_EQ(sum(film, 2), static_cast<double>(counts.searches));
        EXPECT_EQ(counts.segments, film.segments);
    });
}

TEST(Meshes, what_cannot_be_with_them_is_refused_with_the_reason) {
    on_every_device([&](const ocl::Device& device) {
        const Scene scene = mesh_room();
        const auto reason = [&](auto&& change) {
            RenderJob job = small_job(3, 2);
            change(job);
            return unsupported_reason(integrator("pt"), device, scene, job);
        };
        EXPECT_EQ(reason([](RenderJob&) {}), "");
        EXPECT_EQ(reason([](RenderJob& job) { job.lanes = 8; }),
                  "lanes 8: pt has 1 with meshes, as in scene mesh_room");
        EXPECT_EQ(reason([](RenderJob& job) { job.variant.build = BuildMode::relaxed; }),
                  "build relaxed: pt loses rays at edges so; with meshes it has default, strict");
        EXPECT_EQ(reason([](RenderJob& job) { job.variant.scene_memory = SceneMemory::local; }),
                  "scene_memory local: pt has spheres beside meshes in auto, constant, global");
        EXPECT_NE(unsupported_reason(integrator("thesis"), device, scene, small_job(3, 2)), "");
        RenderJob spheres = small_job(3, 2);
        spheres.variant.bvh = Bvh::wide8;
        EXPECT_EQ(unsupported_reason(integrator("pt"), device, shipped_scene("thesis"), spheres),
                  "bvh wide8: scene thesis has no meshes");
        ocl::Device small = device;
        small.info.max_alloc_bytes = 1000;
        EXPECT_NE(
            unsupported_reason(integrator("pt"), small, scene, small_job(3, 2)).find("scene mesh_room, "),
            std::string::npos);
    });
}

/// The tree is built otherwise, and what is met is the same.
TEST(Meshes, how_the_tree_is_built_changes_no_bit) {
    const Scene scene = mesh_room();
    on_every_layout(small_job(4, 2), [&](const ocl::Device& device, const RenderJob& each) {
        const Film usual = render_film(device, "pt", scene, each);
        for (const BvhSplit split : {BvhSplit::sah, BvhSplit::spatial_xyz, BvhSplit::sah_xyz}) {
            RenderJob changed = each;
            changed.variant.bvh_split = split;
            EXPECT_EQ(render_film(device, "pt", scene, changed).segments, usual.segments);
        }
    });
}

}  // namespace
}  // namespace ptb
