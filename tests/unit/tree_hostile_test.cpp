// Triangles that builders recurse for ever on, or lose.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "core/tree/tree.h"
#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace ptb {
namespace {

constexpr TreeLayout layouts[] = {TreeLayout::bvh2, TreeLayout::bvh2q, TreeLayout::wide8};

Triangles scaled(Triangles triangles, float factor) {
    for (Triangle& triangle : triangles)
        for (auto& corner : triangle.corners)
            for (float& coordinate : corner) coordinate *= factor;
    return triangles;
}

const Triangle facing = {{{{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}}}};
const Ray towards_it = {{0, 0, 2}, {0, 0, -1}};

TEST(HostileTree, no_triangles_make_a_tree_in_which_nothing_is_met) {
    for (const TreeLayout layout : layouts) {
        const Tree tree = build_tree({}, layout, {}, 3);
        EXPECT_EQ(tree.facts.nodes, 1u);
        EXPECT_EQ(tree.facts.leaves, 0u);
        EXPECT_EQ(tree.facts.sah_cost, 0);
        for (const float x : {-1.0f, 0.0f, 1.0f}) {
            const Met met = walk(tree, {{0, 0, 0}, {x, 1, 1}});
            EXPECT_EQ(met.number, TREE_NOTHING);
            EXPECT_EQ(met.nodes, 1u) << "a place without a child was entered";
        }
    }
}

TEST(HostileTree, a_lone_triangle_is_a_leaf_below_a_root) {
    for (const TreeLayout layout : layouts) {
        const Tree tree = build_tree(Triangles{facing}, layout, {}, 3);
        EXPECT_EQ(tree.nodes2.size() + tree.nodes2q.size() + tree.nodes8.size(), 1u);
        EXPECT_EQ(walk(tree, towards_it).number, 0u);
        EXPECT_EQ(walk(tree, {{0, 0, 2}, {1, 1, 1}}).number, TREE_NOTHING);
    }
}

TEST(HostileTree, identical_triangles_are_halved) {
    const Triangles same(100000, facing);
    const Tree tree = build_tree(same, TreeLayout::bvh2, {}, 2);
    EXPECT_EQ(tree.facts.references, same.size()) << "splits of space would not end";
    EXPECT_LE(tree.facts.depth, 17);
    EXPECT_EQ(walk(tree, towards_it).number, 0u);
}

TEST(HostileTree, centres_in_one_place_are_parted_by_size_or_halved) {
    Triangles around;
    for (int i = 1; i <= 20000; ++i) around.push_back(scaled({facing}, static_cast<float>(i) * 1e-4f)[0]);
    for (const bool size_axis : {false, true}) {
        TreeSettings settings;
        settings.size_axis = size_axis;
        const Tree tree = build_tree(around, TreeLayout::bvh2, settings, 2);
        EXPECT_NEAR(walk(tree, {{0.9f, -0.9f, 1}, {0, 0, -1}}).distance, 1, 1e-9);
        EXPECT_LE(tree.facts.depth, settings.depth_most);
    }
}

TEST(HostileTree, triangles_without_an_area_are_no_trouble) {
    Dice dice(1);
    Triangles points, lines;
    for (int i = 0; i < 3000; ++i) {
        const std::array<float, 3> a{dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)};
        const std::array<float, 3> b{dice.between(-1, 1), a[1], a[2]};
        points.push_back({{a, a, a}});
        lines.push_back({{a, a, b}});
    }
    const Triangles in_one_point(3000, points[0]);
    for (const TreeLayout layout : layouts) {
        for (const Triangles& triangles : {points, lines, in_one_point}) {
            const Tree tree = build_tree(triangles, layout, {}, 2);
            EXPECT_GE(tree.facts.references, triangles.size());
            EXPECT_TRUE(std::isfinite(tree.facts.sah_cost));
        }
        const Tree tree = build_tree(with(points, {facing}), layout, {}, 2);
        EXPECT_EQ(walk(tree, towards_it).number, 3000u);
    }
}

TEST(HostileTree, coordinates_may_be_huge_or_tiny) {
    const Triangles unit = scaled(with(room(1.5f), soup(500, 0.2f)), 0.5f);
    for (const TreeLayout layout : layouts) {
        const Tree plain = build_tree(unit, layout, {}, 1);
        for (const float factor : {0x1p-100f, 0x1p-60f, 0x1p60f, 0x1p120f}) {
            const Tree tree = build_tree(scaled(unit, factor), layout, {}, 1);
            EXPECT_EQ(tree.facts.references, plain.facts.references);
            EXPECT_NEAR(tree.facts.sah_cost, plain.facts.sah_cost, 1e-6) << "another tree at " << factor;
        }
        const Tree edge = build_tree(scaled(unit, 0x1p127f), layout, {}, 1);
        EXPECT_EQ(edge.facts.references, plain.facts.references);
        EXPECT_NO_THROW(build_tree(scaled(unit, 1e-45f), layout, {}, 1)) << "all but zero";
    }
}

TEST(HostileTree, needles_side_by_side_end) {
    Triangles needles;
    Dice dice(2);
    for (int i = 0; i < 5000; ++i) {
        const float x = dice.between(0, 1e-3f), z = dice.between(0, 1e-3f);
        needles.push_back({{{{x, -1, z}, {x + 1e-5f, -1, z}, {1 - x, 1, 1 - z}}}});
    }
    TreeSettings settings;
    settings.spatial.alpha = 0;
    settings.spatial.room = 3;
    for (const TreeLayout layout : layouts) {
        const Tree tree = build_tree(needles, layout, settings, 2);
        EXPECT_LE(tree.facts.references, 4 * needles.size());
        EXPECT_LE(tree.facts.depth, settings.depth_most);
    }
}

TEST(HostileTree, depth_is_bounded_where_splits_peel_off_one_after_the_other) {
    Triangles shrinking;
    for (int i = 0; i < 2000; ++i) {
        Triangle triangle = facing;
        for (auto& corner : triangle.corners)
            for (float& x : corner)
                x = x * std::exp2(-0.05f * static_cast<float>(i)) + std::exp2(-0.05f * static_cast<float>(i));
        shrinking.push_back(triangle);
    }
    TreeSettings settings;
    settings.depth_most = 64;
    const int deep = build_tree(shrinking, TreeLayout::bvh2, settings, 1).facts.depth;
    settings.depth_most = 30;
    EXPECT_GT(deep, 30) << "nothing to bound";
    EXPECT_LE(build_tree(shrinking, TreeLayout::bvh2, settings, 1).facts.depth, 30);
}

TEST(HostileTree, corners_that_are_no_numbers_are_refused) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
        Triangles triangles = soup(20000, 0.1f);
        triangles[17000].corners[1][2] = bad;
        try {
            build_tree(triangles, TreeLayout::bvh2, {}, 2);
            FAIL() << "not refused";
        } catch (const std::invalid_argument& error) {
            EXPECT_STREQ(error.what(), "triangle 17000: a corner is not finite");
        }
    }
}

}  // namespace
}  // namespace ptb
