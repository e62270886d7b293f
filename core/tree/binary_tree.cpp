#include "core/tree/binary_tree.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "core/tree/partition.h"

namespace ptb::tree {
namespace {

constexpr std::size_t whole_from = 1u << 12;  ///< references: nodes of fewer are built with all below them

/// What all threads share.
struct Site {
    const Soup& soup;
    const Rules& rules;
    Crew& crew;
    float overlap_least;  ///< half area that children have to share for a spatial split to be tried
};

/// A node of the crown, which tasks fill in; at its ends a piece of the tree, whose leaves count from 0.
struct Branch {
    BinaryTree piece;
    std::unique_ptr<Branch> left, right;
    std::size_t nodes = 0;
};

bool cheaper_as_leaf(const Range& range, float work, const Rules& rules) {
    const float area = half_area(range.group.box);
    const float as_leaf = rules.test * static_cast<float>(rules.tests(range.group.count)) * area;
    return range.group.count <= rules.leaf_most && as_leaf <= area + rules.test * work;
}

/// Whether halving can still make leaves of what the split leaves.
bool deep_enough(const Split& split, int depth, const Rules& rules) {
    const auto most = std::max(split.left_count, split.right_count);
    return split.found() && rules.levels_to_leaf(most) < rules.settings.depth_most - depth;
}

bool spatial_may_help(const Range& range, const Split& object, int depth, const Site& site) {
    const TreeSettings& settings = site.rules.settings;
    return settings.method == TreeMethod::spatial && depth < settings.spatial.depth_most &&
           range.room() > 0 &&
           (!object.found() || half_area(intersection(object.left, object.right)) > site.overlap_least);
}

/// The children of a node at this depth; nothing of what is to be a leaf.
std::optional<Halves> divide(const Range& range, int depth, const Site& site) {
    const Rules& rules = site.rules;
    if (range.group.count <= 1) return {};
    const auto references = range.references();
    const Split object = find_object_split(range.group, references, rules, site.crew);
    Split spatial;
    if (spatial_may_help(range, object, depth, site))
        spatial = find_spatial_split(range.group, references, range.room(), site.soup, rules, site.crew);
    if (cheaper_as_leaf(range, std::min(object.work, spatial.work), rules)) return {};
    if (spatial.work < object.work && deep_enough(spatial, depth, rules))
        return part(range, spatial, &site.soup);
    if (deep_enough(object, depth, rules)) return part(range, object, nullptr);
    return halve(range);
}

BinaryNode node_of(const Box& box) {
    return {{box.low[0], box.low[1], box.low[2]}, 0, {box.high[0], box.high[1], box.high[2]}, 0};
}

void append_leaf(BinaryTree& tree, const Range& range) {
    tree.nodes.back().link = static_cast<std::uint32_t>(tree.numbers.size());
    tree.nodes.back().count = static_cast<std::uint32_t>(range.group.count);
    for (const Reference& reference : range.references()) tree.numbers.push_back(reference.number());
}

void append(BinaryTree& tree, const Range& range, int depth, const Site& site) {
    const auto number = tree.nodes.size();
    tree.nodes.push_back(node_of(range.group.box));
    const auto halves = divide(range, depth, site);
    if (!halves) return append_leaf(tree, range);
    append(tree, halves->left, depth + 1, site);
    tree.nodes[number].link = static_cast<std::uint32_t>(tree.nodes.size() - number);
    append(tree, halves->right, depth + 1, site);
}

void grow_branch(Branch& branch, const Range& range, int depth, const Site& site) {
    const auto halves = range.group.count < whole_from ? std::nullopt : divide(range, depth, site);
    if (!halves) return append(branch.piece, range, depth, site);
    branch.piece.nodes.push_back(node_of(range.group.box));
    branch.left = std::make_unique<Branch>();
    branch.right = std::make_unique<Branch>();
    for (const bool right : {true, false}) {
        Branch& child = right ? *branch.right : *branch.left;
        const Range& half = right ? halves->right : halves->left;
        site.crew.add([&child, half, depth, &site] { grow_branch(child, half, depth + 1, site); });
    }
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
    tree.nodes[first_node].link = static_cast<std::uint32_t>(tree.nodes.size() - first_node);
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

}  // namespace

BinaryTree build_binary_tree(const Soup& soup, const Rules& rules, Crew& crew) {
    BinaryTree tree;
    if (soup.size() == 0) return tree;
    const auto room = room_for(soup.size(), rules.settings);
    const auto references = std::make_unique_for_overwrite<Reference[]>(room);
    const Range all = refer_to_all(soup, {references.get(), room}, crew);
    const Site site{soup, rules, crew, rules.settings.spatial.alpha * half_area(all.group.box)};
    auto root = std::make_unique<Branch>();
    crew.add([&] { grow_branch(*root, all, 0, site); });
    crew.finish();
    join_branches(tree, std::move(root));
    return tree;
}

}  // namespace ptb::tree
