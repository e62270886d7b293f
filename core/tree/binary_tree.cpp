#include "core/tree/binary_tree.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "core/tree/partition.h"
#include "shared/tree.h"

namespace ptb::tree {
namespace {

constexpr std::size_t whole_from = 1u << 12;  ///< references: nodes of fewer are built with all below them

/// What all threads share.
struct Site {
    const Soup& soup;
    const TreeSettings& settings;
    Crew& crew;
    float overlap_least;  ///< half area that children have to share for a spatial split to be tried
};

/// A node of the crown, which tasks fill in; at its ends a piece of the tree, whose leaves count from 0.
struct Branch {
    BinaryTree piece;
    std::unique_ptr<Branch> left, right;
};

/// Whether halving can still make leaves of what the split leaves.
bool deep_enough(const Split& split, int depth, const TreeSettings& settings) {
    const auto most = std::max(split.left_count, split.right_count);
    return split.found() && static_cast<int>(std::bit_width(most - 1)) < settings.depth_most - depth;
}

bool spatial_may_help(const Range& range, const Split& object, int depth, const Site& site) {
    const TreeSettings& settings = site.settings;
    return settings.method == TreeMethod::spatial && depth < settings.spatial.depth_most &&
           range.room() > 0 &&
           (!object.found() || half_area(intersection(object.left, object.right)) > site.overlap_least);
}

/// Parts of triangles that are better off whole may leave nothing on a side of a plane.
Halves halve_if_undivided(const Halves& halves) {
    if (halves.left.group.count == 0) return halve(halves.right);
    if (halves.right.group.count == 0) return halve(halves.left);
    return halves;
}

/// The children of a node of several references.
Halves divide(const Range& range, int depth, const Site& site) {
    const auto references = range.references();
    const Split object = find_object_split(range.group, references, site.settings, site.crew);
    Split spatial;
    if (spatial_may_help(range, object, depth, site))
        spatial =
            find_spatial_split(range.group, references, range.room(), site.soup, site.settings, site.crew);
    if (spatial.work < object.work && deep_enough(spatial, depth, site.settings))
        return halve_if_undivided(part(range, spatial, &site.soup));
    if (deep_enough(object, depth, site.settings)) return part(range, object, nullptr);
    return halve(range);
}

void append(BinaryTree& tree, const Range& range, int depth, const Site& site) {
    const std::size_t node = add_node(tree, range.group.box);
    if (range.group.count == 1) return add_to_leaf(tree, range.first->number());
    const Halves halves = divide(range, depth, site);
    append(tree, halves.left, depth + 1, site);
    end_left_child(tree, node);
    append(tree, halves.right, depth + 1, site);
}

void grow_branch(Branch& branch, const Range& range, int depth, const Site& site) {
    if (range.group.count < whole_from) return append(branch.piece, range, depth, site);
    add_node(branch.piece, range.group.box);
    const Halves halves = divide(range, depth, site);
    const auto grow_child = [&site, depth](std::unique_ptr<Branch>& child, const Range& half) {
        child = std::make_unique<Branch>();
        site.crew.add([&branch = *child, half, depth, &site] { grow_branch(branch, half, depth + 1, site); });
    };
    grow_child(branch.right, halves.right);
    grow_child(branch.left, halves.left);
}

/// Puts the pieces together, and drops them.
void join_branches(BinaryTree& tree, std::unique_ptr<Branch> branch) {
    const auto first_node = tree.nodes.size();
    const auto first_number = static_cast<std::uint32_t>(tree.numbers.size());
    for (BinaryNode node : branch->piece.nodes) {
        if (node.count > 0) node.link += first_number;
        tree.nodes.push_back(node);
    }
    tree.numbers.insert(tree.numbers.end(), branch->piece.numbers.begin(), branch->piece.numbers.end());
    if (!branch->left) return;
    branch->piece = {};
    join_branches(tree, std::move(branch->left));
    end_left_child(tree, first_node);
    join_branches(tree, std::move(branch->right));
}

/// All triangles at the begin of the room that there is.
Range refer_to_all(const Soup& soup, std::span<Reference> room, Crew& crew) {
    Range range{room.data(), room.data() + room.size(), room.data(), room.data() + soup.size(), {}};
    std::mutex mutex;
    crew.for_chunks(soup.size(), chunk_size, [&](std::size_t begin, std::size_t end) {
        Group group;
        for (std::size_t i = begin; i < end; ++i) {
            room[i] = soup.whole(static_cast<std::uint32_t>(i));
            group.take(room[i]);
        }
        const std::lock_guard lock(mutex);
        range.group.take(group);
    });
    return range;
}

std::size_t room_for(std::size_t triangles, const TreeSettings& settings) {
    constexpr std::size_t most = TREE_LEAF / TREE_LEAF_MOST;  // that links can tell apart
    const double further = settings.method == TreeMethod::sah ? 0 : settings.spatial.room;
    const auto room = triangles + static_cast<std::size_t>(further * static_cast<double>(triangles));
    if (room > most)
        throw std::length_error(fmt::format("{} triangles: trees hold {} references", triangles, most));
    return room;
}

/// Over all triangles; what they need of memory while it grows is gone afterwards.
std::unique_ptr<Branch> grow_root(const Soup& soup, const TreeSettings& settings, Crew& crew) {
    const auto room = room_for(soup.size(), settings);
    const auto references = std::make_unique_for_overwrite<Reference[]>(room);
    const Range all = refer_to_all(soup, {references.get(), room}, crew);
    const Site site{soup, settings, crew, settings.spatial.alpha * half_area(all.group.box)};
    auto root = std::make_unique<Branch>();
    crew.add([&] { grow_branch(*root, all, 0, site); });
    crew.finish();
    return root;
}

}  // namespace

std::size_t add_node(BinaryTree& tree, const Box& box) {
    tree.nodes.push_back(
        {{box.low[0], box.low[1], box.low[2]}, 0, {box.high[0], box.high[1], box.high[2]}, 0});
    return tree.nodes.size() - 1;
}

void end_left_child(BinaryTree& tree, std::size_t node) {
    tree.nodes[node].link = static_cast<std::uint32_t>(tree.nodes.size() - node);
}

void add_to_leaf(BinaryTree& tree, std::uint32_t number) {
    BinaryNode& leaf = tree.nodes.back();
    if (leaf.count++ == 0) leaf.link = static_cast<std::uint32_t>(tree.numbers.size());
    tree.numbers.push_back(number);
}

BinaryTree build_binary_tree(const Soup& soup, const TreeSettings& settings, Crew& crew) {
    BinaryTree tree;
    if (soup.size() > 0) join_branches(tree, grow_root(soup, settings, crew));
    return tree;
}

}  // namespace ptb::tree
