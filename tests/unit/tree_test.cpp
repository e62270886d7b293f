#include "core/tree/tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <set>

#include <gmock/gmock.h>

#include "core/tree/pack.h"
#include "tests/support/tree_walk.h"
#include "tests/support/triangles.h"

namespace ptb {
namespace {

constexpr TreeLayout layouts[] = {TreeLayout::bvh2, TreeLayout::bvh2q, TreeLayout::wide8};

TreeSettings settings_of(TreeMethod method, bool size_axis) {
    TreeSettings settings;
    settings.method = method;
    settings.size_axis = size_axis;
    return settings;
}

const TreeSettings all_settings[] = {settings_of(TreeMethod::sah, false), settings_of(TreeMethod::sah, true),
                                     settings_of(TreeMethod::spatial, false),
                                     settings_of(TreeMethod::spatial, true)};

void with_every_tree(const Triangles& triangles, const std::function<void(const Tree&)>& check) {
    for (const TreeLayout layout : layouts)
        for (const TreeSettings& settings : all_settings) check(build_tree(triangles, layout, settings, 2));
}

/// Through the cube of `reach` around the origin, every fourth along an axis.
Ray random_ray(Dice& dice, float reach) {
    Ray ray;
    for (float& x : ray.origin) x = dice.between(-reach, reach);
    for (float& x : ray.direction) x = dice.between(-1, 1);
    if (dice.uniform() < 0.25) ray.direction = {0, dice.uniform() < 0.5 ? -0.0f : 1.0f, 0};
    if (ray.direction[1] == 0) ray.direction[2] = -1;
    return ray;
}

void expect_nearest(const Tree& tree, const Triangles& triangles, int rays, float reach) {
    Dice dice(3);
    for (int i = 0; i < rays; ++i) {
        const Ray ray = random_ray(dice, reach);
        const Met met = walk(tree, ray), truth = look_everywhere(triangles, ray);
        ASSERT_EQ(met.number, truth.number) << "ray " << i << ": a triangle is lost";
        ASSERT_EQ(met.distance, truth.distance) << "ray " << i;
    }
}

TEST(Tree, nearest_triangles_are_those_of_looking_at_all) {
    const Triangles scenes[] = {soup(700, 0.3f), with(room(2), slivers(300)), with(room(1.5f), flake(1, 5)),
                                menger(1),       with(menger(1), menger(1)),  terrain(12)};
    for (const Triangles& scene : scenes)
        with_every_tree(scene, [&](const Tree& tree) { expect_nearest(tree, scene, 150, 1.4f); });
}

/// From so close to a triangle that hardly anything is in between.
Ray aimed_at(const Triangle& triangle, const Vec3& point, double distance) {
    const Vec3 from = point + distance * normalized(normal_of(triangle));
    Ray ray;
    const auto set = [](const Vec3& v, std::array<float, 3>& to) {
        to = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    set(from, ray.origin);
    set(point - to_vec3(ray.origin), ray.direction);
    return ray;
}

TEST(Tree, every_triangle_is_found_by_a_ray_aimed_at_it) {
    const Triangles scene = with(with(room(2), soup(8000, 0.1f)), flake(1, 14));
    for (const TreeLayout layout : layouts) {
        const Tree tree = build_tree(scene, layout, {}, 2);
        std::size_t others = 0;
        for (std::uint32_t i = 0; i < scene.size(); ++i) {
            const auto& [a, b, c] = scene[i].corners;
            const Vec3 middle = (to_vec3(a) + to_vec3(b) + to_vec3(c)) * (1.0 / 3);
            const Met met = walk(tree, aimed_at(scene[i], middle, 1e-3));
            ASSERT_LT(met.distance, 1.001) << "triangle " << i << " is lost";
            others += met.number != i ? 1 : 0;
        }
        EXPECT_LT(others, scene.size() / 20) << "something else is nearly always in the way";
    }
}

// ---- what is in leaves, and around them ----

struct Contents {
    std::vector<std::uint32_t> numbers;
    std::size_t largest_leaf = 0;
    void add_leaf(const std::vector<std::uint32_t>& leaf) {
        numbers.insert(numbers.end(), leaf.begin(), leaf.end());
        largest_leaf = std::max(largest_leaf, leaf.size());
    }
};

std::vector<std::uint32_t> leaf_of(const Tree& tree, std::uint32_t link) {
    std::vector<std::uint32_t> numbers;
    const std::uint32_t code = link & ~TREE_LEAF;
    if (tree.nodes8.empty()) {
        const std::size_t first = code / TREE_LEAF_MOST;
        for (std::size_t i = first; i <= first + code % TREE_LEAF_MOST; ++i)
            numbers.push_back(std::bit_cast<std::uint32_t>(tree.triangles.at(i).a_number.w));
    } else {
        for (const ptb_uint number : tree.blocks.at(code).number)
            if (number != TREE_NOTHING) numbers.push_back(number);
    }
    return numbers;
}

struct Bounds {
    std::array<float, 3> low, high;
    bool contain(const std::array<float, 3>& point) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (!(low[i] <= point[i] && point[i] <= high[i])) return false;
        return true;
    }
};

struct Place {
    std::uint32_t link;
    Bounds bounds;
};

Place place_around(const ptb_float4& centre, const ptb_float4& half) {
    return {std::bit_cast<std::uint32_t>(centre.w),
            {{centre.x - half.x, centre.y - half.y, centre.z - half.z},
             {centre.x + half.x, centre.y + half.y, centre.z + half.z}}};
}

/// As large as a ray finds it.
Place place_on(const TreeGrid& grid, std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t link) {
    const auto corner = [&](bool high) {
        const auto seen = [&](std::uint32_t planes, float low, float cells, float room) {
            const auto plane = std::bit_cast<float>(TREE_PLANE | (planes >> (high ? 16 : 0) & 0xffffu) << 8);
            return static_cast<float>(low + (plane + (high ? room : -room) - 0.5) / double{cells});
        };
        return std::array{seen(x, grid.low.x, grid.cells.x, grid.room.x),
                          seen(y, grid.low.y, grid.cells.y, grid.room.y),
                          seen(z, grid.low.z, grid.cells.z, grid.room.z)};
    };
    return {link, {corner(false), corner(true)}};
}

std::vector<Place> places_of(const Tree& tree, std::uint32_t node) {
    std::vector<Place> places;
    if (!tree.nodes2q.empty()) {
        const TreeNode2q& n = tree.nodes2q.at(node);
        places.push_back(place_on(tree.grid, n.x0, n.y0, n.z0, n.link0));
        places.push_back(place_on(tree.grid, n.x1, n.y1, n.z1, n.link1));
    } else if (tree.nodes8.empty()) {
        const TreeNode2& n = tree.nodes2.at(node);
        places.push_back(place_around(n.centre0_link, n.half0));
        places.push_back(place_around(n.centre1_link, n.half1));
    } else {
        const TreeNode8& n = tree.nodes8.at(node);
        for (std::size_t i = 0; i < 8; ++i)
            places.push_back(
                {n.link[i],
                 {{n.low[0][i], n.low[1][i], n.low[2][i]}, {n.high[0][i], n.high[1][i], n.high[2][i]}}});
    }
    std::erase_if(places, [](const Place& place) { return place.link == TREE_NOTHING; });
    return places;
}

void look_into(const Tree& tree, const Place& place, const std::function<void(const Place&)>& each) {
    each(place);
    if (place.link & TREE_LEAF) return;
    for (const Place& below : places_of(tree, place.link)) look_into(tree, below, each);
}

Contents contents_of(const Tree& tree) {
    Contents contents;
    look_into(tree, {0, {}}, [&](const Place& place) {
        if (place.link & TREE_LEAF) contents.add_leaf(leaf_of(tree, place.link));
    });
    std::sort(contents.numbers.begin(), contents.numbers.end());
    return contents;
}

std::size_t different(const std::vector<std::uint32_t>& sorted) {
    return std::set<std::uint32_t>(sorted.begin(), sorted.end()).size();
}

TEST(Tree, leaves_hold_every_triangle_and_no_more_than_the_layout_allows) {
    const Triangles scene = with(room(2), soup(1000, 0.4f));
    with_every_tree(scene, [&](const Tree& tree) {
        const Contents contents = contents_of(tree);
        EXPECT_EQ(different(contents.numbers), scene.size());
        EXPECT_EQ(contents.numbers.back(), scene.size() - 1);
        EXPECT_EQ(contents.numbers.size(), tree.facts.references);
        EXPECT_LE(contents.largest_leaf, tree.nodes8.empty() ? TREE_LEAF_MOST : 8u);
        EXPECT_GT(contents.largest_leaf, 1u);
    });
}

TEST(Tree, boxes_contain_what_is_below_them) {
    const Triangles scene = with(room(2), soup(2000, 0.4f));
    for (const TreeLayout layout : layouts) {
        const Tree tree = build_tree(scene, layout, settings_of(TreeMethod::sah, true), 1);
        for (const Place& top : places_of(tree, 0))
            look_into(tree, top, [&](const Place& place) {
                if (layout == TreeLayout::wide8 &&
                    !(place.link & TREE_LEAF)) {  // which has boxes as they are
                    for (const Place& below : places_of(tree, place.link))
                        ASSERT_TRUE(place.bounds.contain(below.bounds.low) &&
                                    place.bounds.contain(below.bounds.high));
                }
                look_into(tree, place, [&](const Place& below) {
                    if (!(below.link & TREE_LEAF)) return;
                    for (const std::uint32_t number : leaf_of(tree, below.link))
                        for (const auto& corner : scene[number].corners)
                            ASSERT_TRUE(place.bounds.contain(corner));
                });
            });
    }
}

TEST(Tree, boxes_are_larger_by_units_in_the_last_place_of_the_largest_coordinate) {
    const Triangles scene = {{{{{0, 0, 0}, {1, 0, 0}, {0, 6, -0.5f}}}}};  // units of 4 to 8 are 2^-21
    for (const auto& [layout, more] :
         {std::pair{TreeLayout::wide8, 0x1p-20f}, {TreeLayout::bvh2, 0x1.8p-19f}}) {
        const Bounds bounds = places_of(build_tree(scene, layout, {}, 1), 0).at(0).bounds;
        EXPECT_EQ(bounds.low, (std::array{-more, -more, -0.5f - more}));
        EXPECT_EQ(bounds.high, (std::array{1 + more, 6 + more, more}));
    }
}

TEST(Tree, rays_from_a_wall_do_not_test_that_wall_again) {
    for (const float half_edge : {1.0f, 1.9f, 2.5f, 3.999f}) {
        for (const TreeLayout layout : {TreeLayout::bvh2, TreeLayout::bvh2q}) {
            const Tree tree = build_tree(room(half_edge), layout, {}, 1);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (const float side : {-1.0f, 1.0f}) {
                    Ray ray = {{0.3f * half_edge, 0.2f * half_edge, 0.1f * half_edge}, {0.01f, 0.02f, 0.03f}};
                    ray.origin[axis] = side * (half_edge - TRIANGLE_MARGIN * half_edge);
                    ray.direction[axis] = -side;
                    EXPECT_LE(walk(tree, ray).tests, 2u) << half_edge << ' ' << axis << ' ' << side;
                }
            }
        }
    }
}

/// At corners of the outermost walls, where a box that is met too small loses them.
TEST(Tree, rays_from_outside_of_the_grid_miss_no_box) {
    const Triangles scene = with(room(1), soup(300, 0.3f));
    for (const float most : {1.3f, 1.99f, 3.9f, 31.0f}) {
        TreeSettings settings;
        settings.origin_most = most;
        const Tree tree = build_tree(scene, TreeLayout::bvh2q, settings, 1);
        EXPECT_GE(tree.grid.room.x * tree.grid.cell.x, 10 * 0x1p-24f * most);
        Dice dice(5);
        for (int i = 0; i < 20000; ++i) {
            const auto& corner =
                scene[static_cast<std::size_t>(i) % 12].corners[static_cast<std::size_t>(i) % 3];
            Ray ray = {{dice.between(-most, most), dice.between(-most, most), most}, {}};
            for (std::size_t axis = 0; axis < 3; ++axis)
                ray.direction[axis] = corner[axis] * dice.between(0.9999f, 1) - ray.origin[axis];
            ASSERT_LE(walk(tree, ray).distance, look_everywhere(scene, ray).distance) << most << " ray " << i;
        }
    }
}

TEST(Tree, a_grid_that_holds_no_box_is_not_used) {
    TreeSettings far;
    far.origin_most = 2e4f;
    const Triangles small = {{{{{0, 0, 0}, {0.01f, 0, 0}, {0, 0.01f, 0}}}}};
    const Tree tree = build_tree(small, TreeLayout::bvh2q, far, 1);
    EXPECT_TRUE(tree.nodes2q.empty());
    EXPECT_EQ(tree.nodes2.size(), 1u);
    EXPECT_EQ(walk(tree, {{1e4f, 0, 0}, {0, 1, 0}}).number, TREE_NOTHING);
}

TEST(Tree, a_grid_too_coarse_for_what_is_small_is_not_used) {
    const auto quantised = [](float half_edge, double most) {
        TreeSettings settings;
        settings.grid_growth_most = most;
        return build_tree(with(room(half_edge), flake(1, 8)), TreeLayout::bvh2q, settings, 1);
    };
    const Tree fine = quantised(2, 2), coarse = quantised(2000, 1e9), told = quantised(2000, 2);
    EXPECT_LT(fine.facts.grid_growth, 1.1);
    EXPECT_FALSE(fine.nodes2q.empty());
    EXPECT_GT(coarse.facts.grid_growth, 2);
    EXPECT_FALSE(coarse.nodes2q.empty());
    EXPECT_TRUE(told.nodes2q.empty());
    EXPECT_EQ(told.facts.grid_growth, 1);
    EXPECT_EQ(told.nodes2.size(), coarse.nodes2q.size());
}

TEST(Tree, rays_from_farther_away_need_larger_boxes) {
    TreeSettings settings;
    settings.origin_most = 24;
    const Triangles scene = {{{{{0, 0, 0}, {1, 0, 0}, {0, 6, -0.5f}}}}};
    const Tree tree = build_tree(scene, TreeLayout::wide8, settings, 1);
    EXPECT_EQ(places_of(tree, 0).at(0).bounds.low, (std::array{-0x1p-18f, -0x1p-18f, -0.5f - 0x1p-18f}));
}

// ---- the same bytes for any number of threads ----

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_bytes(const Tree& a, const Tree& b) {
    return same_bytes(a.nodes2, b.nodes2) && same_bytes(a.nodes2q, b.nodes2q) &&
           std::memcmp(&a.grid, &b.grid, sizeof a.grid) == 0 && same_bytes(a.triangles, b.triangles) &&
           same_bytes(a.nodes8, b.nodes8) && same_bytes(a.blocks, b.blocks) && a.facts == b.facts;
}

TEST(Tree, any_number_of_threads_builds_the_same_bytes) {
    const Triangles scene = with(with(room(2), hair(500, 4)), terrain(130));
    const Tree alone = build_tree(scene, TreeLayout::bvh2, {}, 1);
    EXPECT_GT(alone.facts.references, scene.size()) << "no spatial split was tried";
    for (const int threads : {2, 3, 8})
        EXPECT_TRUE(same_bytes(alone, build_tree(scene, TreeLayout::bvh2, {}, threads)))
            << threads << " threads";
    for (const TreeLayout layout : layouts)
        EXPECT_TRUE(same_bytes(build_tree(scene, layout, {}, 1), build_tree(scene, layout, {}, 3)))
            << static_cast<int>(layout);
}

// ---- facts ----

TEST(Tree, a_lone_triangle_costs_a_node_and_a_test) {
    const Triangles one = soup(1, 1);
    const TreeFacts facts = build_tree(one, TreeLayout::bvh2, {}, 1).facts;
    EXPECT_NEAR(facts.sah_cost, 2.0, 1e-6);
    EXPECT_EQ(facts.bytes, 64u + 48u);
    EXPECT_EQ(std::tuple(facts.triangles, facts.references, facts.nodes, facts.leaves),
              std::tuple(1u, 1u, 1u, 1u));
    EXPECT_EQ(std::pair(facts.depth, facts.stack_most), std::pair(1, 0));
}

TEST(Tree, leaves_cost_by_the_share_of_rays_that_reach_them) {
    const Triangle square = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    Triangle away = square;  // the box of both is 11 x 1, theirs are 1 x 1
    for (auto& corner : away.corners) corner[0] += 10;
    const TreeFacts facts = build_tree(Triangles{square, away}, TreeLayout::bvh2, {}, 1).facts;
    EXPECT_NEAR(facts.sah_cost, 1 + 2 * 1.0 / 11, 1e-4);
    EXPECT_EQ(std::pair(facts.leaves, facts.stack_most), std::pair(std::size_t{2}, 1));
}

// ---- settings ----

double work_in_room(const Triangles& scene, const TreeSettings& settings) {
    const Tree tree = build_tree(scene, TreeLayout::bvh2, settings, 2);
    Dice dice(5);
    double work = 0;
    for (int i = 0; i < 4000; ++i) {
        const Met met = walk(tree, random_ray(dice, 2.9f));
        work += met.nodes + 0.7 * met.tests;
    }
    return work;
}

TEST(Tree, large_walls_are_parted_from_small_things_by_size) {
    const Triangles scene = with(room(3), flake(2, 8));
    TreeSettings with_sizes = settings_of(TreeMethod::sah, true),
                 without = settings_of(TreeMethod::sah, false);
    with_sizes.reinsertion.passes_most = without.reinsertion.passes_most = 0;
    EXPECT_LT(work_in_room(scene, with_sizes), 0.9 * work_in_room(scene, without));
}

TEST(Tree, what_moves_to_better_places_saves_work) {
    const Triangles scene = with(room(3), slivers(2000));
    TreeSettings resting = settings_of(TreeMethod::spatial, true), moving = resting;
    resting.reinsertion.passes_most = 0;
    EXPECT_LT(work_in_room(scene, moving), 0.85 * work_in_room(scene, resting));
    EXPECT_LT(build_tree(scene, TreeLayout::bvh2, moving, 1).facts.sah_cost,
              0.9 * build_tree(scene, TreeLayout::bvh2, resting, 1).facts.sah_cost);
}

TEST(Tree, space_is_split_only_where_there_is_room_for_more_references) {
    const Triangles scene = with(room(1), hair(600, 8));
    TreeSettings settings = settings_of(TreeMethod::spatial, false);
    settings.spatial.alpha = 1e-5f;
    EXPECT_GT(build_tree(scene, TreeLayout::bvh2, settings, 1).facts.references, scene.size() * 106 / 100);
    settings.spatial.room = 0.05f;
    const auto few = build_tree(scene, TreeLayout::bvh2, settings, 1).facts.references;
    EXPECT_GT(few, scene.size());
    EXPECT_LE(few, scene.size() * 105 / 100);
    settings.spatial.room = 0;
    EXPECT_EQ(build_tree(scene, TreeLayout::bvh2, settings, 1).facts.references, scene.size());
}

TEST(Tree, senseless_settings_are_refused) {
    const auto refused = [](auto change) -> std::string {
        TreeSettings settings;
        change(settings);
        try {
            build_tree({}, TreeLayout::bvh2, settings, 1);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refused([](TreeSettings& s) { s.bins = 1; }), "tree setting bins 1: must be 2 to 32");
    EXPECT_EQ(refused([](TreeSettings& s) { s.bins = 33; }), "tree setting bins 33: must be 2 to 32");
    EXPECT_EQ(refused([](TreeSettings& s) { s.depth_most = 29; }),
              "tree setting depth_most 29: must be 30 to 64");
    EXPECT_EQ(refused([](TreeSettings& s) { s.spatial.alpha = NAN; }),
              "tree setting spatial.alpha nan: must be 0 to 1");
    EXPECT_EQ(refused([](TreeSettings& s) { s.spatial.depth_most = -1; }),
              "tree setting spatial.depth_most -1: must be 0 to 64");
    EXPECT_EQ(refused([](TreeSettings& s) { s.spatial.room = 4; }),
              "tree setting spatial.room 4: must be 0 to 3");
    EXPECT_EQ(refused([](TreeSettings& s) { s.reinsertion.passes_most = 101; }),
              "tree setting reinsertion.passes_most 101: must be 0 to 100");
    EXPECT_EQ(refused([](TreeSettings& s) { s.reinsertion.gain_least = -0.5f; }),
              "tree setting reinsertion.gain_least -0.5: must be 0 to 1");
    EXPECT_EQ(refused([](TreeSettings& s) { s.cost.triangle = 0; }),
              "tree setting cost.triangle 0: must be 0.01 to 100");
    EXPECT_EQ(refused([](TreeSettings& s) { s.cost.block = 1e3f; }),
              "tree setting cost.block 1000: must be 0.01 to 100");
    EXPECT_EQ(refused([](TreeSettings& s) { s.origin_most = -1; }),
              "tree setting origin_most -1: must be 0 to 1e+30");
    EXPECT_THROW(build_tree({}, TreeLayout::bvh2, {}, 0), std::invalid_argument);
}

TEST(Tree, a_leaf_that_the_layout_cannot_hold_is_an_error) {
    const Triangles five = soup(5, 0.1f), nine = soup(9, 0.1f);
    tree::Crew crew(1);
    for (const Triangles& triangles : {five, nine}) {
        tree::BinaryTree one_leaf;
        one_leaf.nodes.push_back({{-2, -2, -2}, 0, {2, 2, 2}, static_cast<std::uint32_t>(triangles.size())});
        for (std::uint32_t i = 0; i < triangles.size(); ++i) one_leaf.numbers.push_back(i);
        const tree::Padding padding(tree::Soup(triangles, crew), {});
        const tree::Load load{one_leaf, triangles, padding, crew};
        EXPECT_THROW(pack2(load), std::logic_error) << triangles.size();
        if (triangles.size() == 5)
            EXPECT_NO_THROW(pack8(load));
        else
            EXPECT_THROW(pack8(load), std::logic_error);
    }
}

TEST(Tree, a_key_tells_triangles_settings_and_layouts_apart) {
    Triangles triangles = soup(100, 0.1f);
    const TreeKey key = tree_key(triangles, TreeLayout::bvh2, {});
    EXPECT_EQ(key, tree_key(Triangles(triangles), TreeLayout::bvh2, {}));
    EXPECT_NE(key, tree_key(triangles, TreeLayout::wide8, {}));
    EXPECT_NE(key, tree_key(triangles, TreeLayout::bvh2, settings_of(TreeMethod::sah, true)));
    triangles[99].corners[2][2] = std::nextafter(triangles[99].corners[2][2], 9.0f);
    EXPECT_NE(key, tree_key(triangles, TreeLayout::bvh2, {}));
    triangles = soup(100, 0.1f);
    std::swap(triangles[3], triangles[4]);
    EXPECT_NE(key, tree_key(triangles, TreeLayout::bvh2, {})) << "their order is their numbers";
    triangles.pop_back();
    EXPECT_NE(key, tree_key(triangles, TreeLayout::bvh2, {}));
}

}  // namespace
}  // namespace ptb
