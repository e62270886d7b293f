#include "tests/support/rays.h"

#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/devices.h"
#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace ptb {
namespace {

/// Runs `body(rays, name)` for a tree in every layout on every device.
template <class Body>
void on_every_tree(const Triangles& triangles, const std::string& more_options, Body&& body) {
    on_every_device([&](const ocl::Device& device) {
        for (const TreeLayout layout : {TreeLayout::bvh2, TreeLayout::bvh2q, TreeLayout::wide8}) {
            SCOPED_TRACE(static_cast<int>(layout));
            const Tree tree = build_tree(triangles, layout, {}, 2);
            RayList list(device, tree, more_options);
            body(list);
        }
    });
}

std::array<double, 3> point_of(const Triangle& triangle, double b, double c) {
    std::array<double, 3> point{};
    for (std::size_t i = 0; i < 3; ++i)
        point[i] =
            (1 - b - c) * triangle.corners[0][i] + b * triangle.corners[1][i] + c * triangle.corners[2][i];
    return point;
}

ListedRay aimed(const std::array<double, 3>& from, const std::array<double, 3>& at) {
    return make_ray(from, {at[0] - from[0], at[1] - from[1], at[2] - from[2]});
}

Ray on_host(const ListedRay& ray) {
    const auto &o = ray.origin_left, &d = ray.direction_reach;
    return {{o.x, o.y, o.z}, {d.x, d.y, d.z}, std::bit_cast<std::uint32_t>(o.w)};
}

/// From anywhere within, in every direction.
std::vector<ListedRay> random_rays(int count, double half_edge) {
    Dice dice(7);
    std::vector<ListedRay> rays;
    const auto number = [&] { return 2 * dice.uniform() - 1; };
    while (static_cast<int>(rays.size()) < count) {
        const std::array<double, 3> from{half_edge * number(), half_edge * number(), half_edge * number()};
        rays.push_back(make_ray(from, {number(), number(), number()}));
    }
    return rays;
}

TEST(Rays, none_aimed_at_an_edge_or_a_corner_of_a_closed_mesh_is_lost) {
    constexpr int count = 100'000;
    const Triangles ball = flake(1, 24);
    Dice dice(3);
    std::vector<ListedRay> rays;
    for (int i = 0; i < 2 * count; ++i) {
        const Triangle& triangle =
            ball[static_cast<std::size_t>(dice.uniform() * static_cast<double>(ball.size()))];
        const double along = i < count ? dice.uniform() : 0;
        rays.push_back(
            aimed({0.3 * dice.uniform(), 0.2 * dice.uniform(), 0.1}, point_of(triangle, along, 0)));
    }
    on_every_tree(ball, "", [&](RayList& list) {
        int lost = 0;
        for (const ListedHit& hit : list.met(rays)) lost += hit.triangle == TREE_NOTHING;
        EXPECT_EQ(lost, 0) << "of " << rays.size();
    });
}

/// The nearest triangle, or one that is as near but for rounding.
void expect_nearest(RayList& list, const std::vector<ListedRay>& rays, const std::vector<Met>& truths) {
    const std::vector<ListedHit> hits = list.met(rays), sights = list.met(rays, true);
    int wrong = 0, unseen = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Met& truth = truths[i];
        const bool met = hits[i].triangle != TREE_NOTHING, there = truth.number != TREE_NOTHING;
        const bool as_far = std::abs(hits[i].distance - truth.distance) < 1e-5 * (1 + truth.distance);
        wrong += met != there || (met && hits[i].triangle != truth.number && !as_far);
        unseen += (sights[i].triangle != TREE_NOTHING) != there;
    }
    EXPECT_EQ(wrong, 0) << "of " << rays.size();
    EXPECT_EQ(unseen, 0) << "of " << rays.size();
}

TEST(Rays, meet_the_nearest_triangle) {
    const std::vector<ListedRay> rays = random_rays(1000, 0.9);
    for (const Triangles& triangles :
         {with(room(1), with(soup(1000, 0.05f), slivers(200))), with(room(1), flake(1, 10)), soup(1, 1)}) {
        std::vector<Met> truths;
        for (const ListedRay& ray : rays) truths.push_back(look_everywhere(triangles, on_host(ray)));
        on_every_tree(triangles, "", [&](RayList& list) { expect_nearest(list, rays, truths); });
    }
}

/// Along the ray to the triangle's plane, and what single precision may add to it: half of what validation
/// allows.
struct PlaneMet {
    double distance, error;
};

PlaneMet plane_of(const Triangle& triangle, const ListedRay& ray) {
    const Ray seen = on_host(ray);
    const Vec3 origin = to_vec3(seen.origin), corner = to_vec3(triangle.corners[0]);
    const Vec3 normal = normalized(normal_of(triangle));
    const double slope = dot(normal, to_vec3(seen.direction)), way = dot(normal, corner - origin);
    const double coordinates = largest_coordinate(corner) + largest_coordinate(origin);
    return {way / slope, 0x1p-21 * coordinates * (1 + 1 / std::abs(slope))};
}

TEST(Rays, are_told_how_far_long_thin_triangles_are) {
    const Triangles thin = slivers(2000);
    Dice dice(11);
    std::vector<ListedRay> rays;
    for (int i = 0; i < 20'000; ++i) {
        const Triangle& triangle = thin[static_cast<std::size_t>(i) % thin.size()];
        const double b = dice.uniform(), c = (1 - b) * dice.uniform();
        rays.push_back(aimed({1.5 - 3 * dice.uniform(), 1.2, -2.3}, point_of(triangle, b, c)));
    }
    on_every_tree(thin, "", [&](RayList& list) {
        const std::vector<ListedHit> hits = list.met(rays);
        int met = 0, wrong = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits[i].triangle == TREE_NOTHING) continue;
            const PlaneMet truth = plane_of(thin.at(hits[i].triangle), rays[i]);
            ++met;
            wrong += !(std::abs(hits[i].distance - truth.distance) <= truth.error);
        }
        EXPECT_GT(met, 19'000);
        EXPECT_EQ(wrong, 0) << "of " << met;
    });
}

TEST(Rays, do_not_meet_the_triangle_that_they_start_at_nor_what_is_out_of_reach) {
    const Triangles walls = room(1);
    std::vector<ListedRay> rays = random_rays(1000, 0.9);
    on_every_tree(walls, "", [&](RayList& list) {
        const std::vector<ListedHit> hits = list.met(rays);
        std::vector<ListedRay> left = rays, near = rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            left[i].origin_left.w = std::bit_cast<float>(hits[i].triangle);
            near[i].direction_reach.w = hits[i].distance * 0.999f;
        }
        for (const ListedHit& hit : list.met(left)) EXPECT_EQ(hit.triangle, TREE_NOTHING);
        for (const ListedHit& hit : list.met(near, true)) EXPECT_EQ(hit.triangle, TREE_NOTHING);
    });
}

TEST(Rays, along_an_axis_take_no_more_steps_than_others) {
    const Triangles triangles = with(room(1), flake(2, 8));
    std::vector<ListedRay> straight, tilted;
    Dice dice(5);
    for (int i = 0; i < 2000; ++i) {
        const std::array<double, 3> from{dice.uniform() - 0.5, dice.uniform() - 0.5, 0.9};
        std::array<double, 3> along{0, 0, 0};
        along[static_cast<std::size_t>(i % 3)] = i % 2 == 0 ? -1 : 1;
        straight.push_back(make_ray(from, along));
        for (double& part : along) part += 1e-2;
        tilted.push_back(make_ray(from, along));
    }
    on_every_tree(triangles, count_option, [&](RayList& list) {
        list.met(tilted);
        const std::uint64_t usual = list.counts()->flops;
        list.met(straight);
        EXPECT_LT(list.counts()->flops, usual + usual / 5);
    });
}

TEST(Rays, that_run_along_edges_and_in_planes_of_triangles_end) {
    const Triangles walls = room(1);
    std::vector<ListedRay> rays;
    for (const Triangle& triangle : walls) {
        const auto a = point_of(triangle, 0, 0), b = point_of(triangle, 1, 0),
                   c = point_of(triangle, 0.25, 0.5);
        rays.insert(rays.end(), {aimed(a, b), aimed(a, c), aimed(c, b)});
    }
    rays.push_back(make_ray({1, 1, 1}, {1, 0, 0}));
    on_every_tree(walls, "", [&](RayList& list) {
        for (const ListedHit& hit : list.met(rays)) EXPECT_FALSE(std::isnan(hit.distance));
    });
}

}  // namespace
}  // namespace ptb
