#include "bench/validate/rays.h"

#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/support/devices.h"
#include "tests/support/render_once.h"
#include "tests/support/scenes.h"

namespace ptb {
namespace {

RenderJob list_of(RayKind kind, int spp = 4) {
    RenderJob job;
    job.size = {32, 32};
    job.spp = spp;
    job.variant.ray_kind = kind;
    return job;
}

template <class Body>
void on_every_list(int spp, Body&& body) {
    on_every_device([&](const ocl::Device& device) {
        for (const RayKind kind : {RayKind::primary, RayKind::bounce1, RayKind::bounce3, RayKind::shadow})
            for (const Bvh layout : {Bvh::bvh2, Bvh::bvh2q, Bvh::wide8}) {
                RenderJob job = list_of(kind, spp);
                job.variant.bvh = layout;
                SCOPED_TRACE(to_string(job.variant));
                body(device, job);
            }
    });
}

Vec3 xyz(const ptb_float4& v) { return {v.x, v.y, v.z}; }

std::uint32_t left_of(const ListedRay& ray) { return std::bit_cast<std::uint32_t>(ray.origin_left.w); }

Vec3 corner(const Triangle& triangle, std::size_t i) {
    return {triangle.corners[i][0], triangle.corners[i][1], triangle.corners[i][2]};
}

Vec3 unit_normal(const Triangle& triangle) {
    const Vec3 a = corner(triangle, 0);
    return normalized(cross(corner(triangle, 1) - a, corner(triangle, 2) - a));
}

TEST(RayLists, every_ray_meets_what_a_search_of_all_triangles_finds) {
    const Scene scene = mesh_room();
    on_every_list(4, [&](const ocl::Device& device, const RenderJob& job) {
        const Film film = render_film(device, "rays", scene, job);
        EXPECT_EQ(film.segments, 4u * 32 * 32);
        EXPECT_EQ(film.rays->rays.size(), film.segments);
        Validation validation;
        validation.valid = true;
        check_rays(validation, *film.rays);
        EXPECT_TRUE(validation.valid) << validation.reason;
    });
}

/// Where a ray goes through an edge, each of two triangles is as right, and what starts there differs.
TEST(RayLists, trees_are_asked_for_the_same_rays) {
    const Scene scene = mesh_room();
    on_every_device([&](const ocl::Device& device) {
        for (const RayKind kind : {RayKind::primary, RayKind::bounce1, RayKind::bounce3, RayKind::shadow}) {
            RenderJob job = list_of(kind);
            job.variant.bvh = Bvh::bvh2;
            const Film two = render_film(device, "rays", scene, job);
            job.variant.bvh = Bvh::wide8;
            job.variant.bvh_split = BvhSplit::sah;
            const Film eight = render_film(device, "rays", scene, job);
            int other = 0;
            for (std::size_t i = 0; i < two.rays->rays.size(); ++i)
                other += std::memcmp(&two.rays->rays[i], &eight.rays->rays[i], sizeof(ListedRay)) != 0;
            EXPECT_LE(other, 4) << to_string(job.variant);
        }
    });
}

TEST(RayLists, work_groups_passes_queues_and_tasks_change_no_bit) {
    const Scene scene = mesh_room();
    on_every_device([&](const ocl::Device& device) {
        const RenderJob job = list_of(RayKind::bounce1);
        const std::string usual = render_film(device, "rays", scene, job).hash;
        const auto render = make_render(device, "rays", scene, job);
        EXPECT_EQ(finish(*render, 100).hash, usual);
        render->restart();
        render->advance(50);
        render->restart();
        EXPECT_EQ(finish(*render, 1000).hash, usual);
        RenderJob changed = job;
        changed.work_group_x = 7;
        EXPECT_EQ(render_film(device, "rays", scene, changed).hash, usual);
        changed.work_group_x = 0;
        changed.variant.dispatch = Dispatch::tasks;
        EXPECT_EQ(render_film(device, "rays", scene, changed).hash, usual);
        changed.variant.queue = QueueOrder::out_of_order;
        if (unsupported_reason(integrator("rays"), device, scene, changed).empty()) {
            EXPECT_EQ(render_film(device, "rays", scene, changed).hash, usual);
        }
        changed = job;
        changed.seed = 2;
        EXPECT_NE(render_film(device, "rays", scene, changed).hash, usual);
    });
}

TEST(RayLists, counting_changes_no_bit_and_counts_the_rays) {
    const Scene scene = mesh_room();
    on_every_device([&](const ocl::Device& device) {
        const RenderJob job = list_of(RayKind::shadow, 1);
        const auto counting = make_render(device, "rays", scene, job, count_option);
        EXPECT_EQ(finish(*counting).hash, render_film(device, "rays", scene, job).hash);
        EXPECT_EQ(counting->counts()->segments, 32u * 32);
    });
}

TEST(RayLists, bounces_leave_surfaces_by_the_cosine_on_the_side_they_were_seen_from) {
    const Scene scene = mesh_room();
    on_every_device([&](const ocl::Device& device) {
        const RaySample sample = *render_film(device, "rays", scene, list_of(RayKind::bounce1)).rays;
        double cosines = 0;
        for (const ListedRay& ray : sample.rays) {
            const Triangle& ground = (*sample.triangles)[left_of(ray)];
            const Vec3 normal = unit_normal(ground), from_plane = xyz(ray.origin_left) - corner(ground, 0);
            const double side = dot(normal, from_plane), cosine = dot(normal, xyz(ray.direction_reach));
            EXPECT_LT(std::abs(side), 1e-5);
            EXPECT_GE(side * cosine, 0) << "it goes through what it starts from";
            cosines += std::abs(cosine);
        }
        const double n = static_cast<double>(sample.rays.size());
        EXPECT_NEAR(cosines / n, 2.0 / 3, 4 * std::sqrt(1.0 / 18 / n));
    });
}

TEST(RayLists, shadow_rays_end_before_triangles_that_shine) {
    const Scene scene = mesh_room();
    const std::size_t first = scene.meshes[0].faces.size(), end = first + scene.meshes[1].faces.size();
    on_every_device([&](const ocl::Device& device) {
        const RaySample sample = *render_film(device, "rays", scene, list_of(RayKind::shadow)).rays;
        for (const ListedRay& ray : sample.rays) {
            const double way = static_cast<double>(ray.direction_reach.w) / RAYS_SHADOW_SHARE;
            const Vec3 at = xyz(ray.origin_left) + xyz(ray.direction_reach) * way;
            double nearest = 1;
            for (std::size_t i = first; i < end; ++i) {
                const Triangle& lamp = (*sample.triangles)[i];
                nearest = std::min(nearest, std::abs(dot(unit_normal(lamp), at - corner(lamp, 0))));
            }
            EXPECT_LT(nearest, 1e-5) << "no lamp is there";
            EXPECT_LT(length(at - Vec3{0, 2, 0}), 0.5 * std::sqrt(3.0) + 1e-5);
        }
    });
}

TEST(RayLists, a_triangle_straight_ahead_has_the_nearness_of_its_distance) {
    Scene scene = lone_triangle();
    scene.camera.position = {0, 0, -3};
    const double look = length(scene.camera.look_at - scene.camera.position);
    on_every_device([&](const ocl::Device& device) {
        const Film film = render_film(device, "rays", scene, list_of(RayKind::primary));
        EXPECT_NEAR(film.mean.rgb[3 * (16 * 32 + 16)], look / (look + 3), 1e-3);
        EXPECT_EQ(film.mean.rgb[0], 0.0f) << "there is nothing in the corner";
        const Film bounced = render_film(device, "rays", scene, list_of(RayKind::bounce1));
        for (const float value : bounced.mean.rgb) ASSERT_EQ(value, 0.0f) << "rays from it meet nothing";
    });
}

TEST(RayLists, rays_without_a_surface_to_start_from_are_an_error) {
    on_every_device([&](const ocl::Device& device) {
        try {
            make_render(device, "rays", lone_triangle(), list_of(RayKind::bounce3));
            FAIL() << "rays were made from nothing";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("found no surface to start from"));
        }
    });
}

TEST(RayLists, what_cannot_be_listed_is_refused_with_the_reason) {
    on_every_device([&](const ocl::Device& device) {
        const auto reason = [&](const std::string& kernel, const Scene& scene, auto&& change) {
            RenderJob job = list_of(RayKind::primary);
            change(job);
            return unsupported_reason(integrator(kernel), device, scene, job);
        };
        const auto shadow = [](RenderJob& job) { job.variant.ray_kind = RayKind::shadow; };
        EXPECT_EQ(reason("rays", mesh_room(), shadow), "");
        EXPECT_EQ(reason("pt", mesh_room(), shadow), "ray_kind shadow: pt lists no rays");
        EXPECT_EQ(reason("rays", shipped_scene("thesis"), [](RenderJob&) {}),
                  "scene thesis has no meshes: rays meets triangles alone");
        Scene dark = mesh_room();
        for (Material& material : dark.materials) material.radiance = {};
        EXPECT_EQ(reason("rays", dark, shadow),
                  "ray_kind shadow: scene mesh_room has no triangle that shines");
        EXPECT_EQ(
            reason("rays", mesh_room(), [](RenderJob& job) { job.variant.roulette = Roulette::albedo; }),
            "roulette albedo: rays has off");
        EXPECT_EQ(reason("rays", mesh_room(),
                         [](RenderJob& job) {
                             job.size = {65536, 32767}, job.spp = 2;
                         }),
                  "size 65536x32767 at spp 2: rays lists at most 2147483648 rays");
    });
}

}  // namespace
}  // namespace ptb
