#include <algorithm>
#include <bit>
#include <limits>

#include "core/tree/pack.h"

namespace ptb::tree {
namespace {

/// How many inner nodes there are before each node: the number of those that are inner themselves.
std::vector<std::uint32_t> count_inner_before(const std::vector<BinaryNode>& nodes) {
    std::vector<std::uint32_t> before;
    before.reserve(nodes.size());
    std::uint32_t inner = 0;
    for (const BinaryNode& node : nodes) {
        before.push_back(inner);
        if (node.count == 0) ++inner;
    }
    return before;
}

ptb_float4 with_bits(Float4 xyz, std::uint32_t bits) {
    return {xyz[0], xyz[1], xyz[2], std::bit_cast<float>(bits)};
}

ptb_float4 corner_of(const Triangle& triangle, std::size_t i, std::uint32_t bits) {
    const auto& c = triangle.corners[i];
    return {c[0], c[1], c[2], std::bit_cast<float>(bits)};
}

TreeTriangle packed(const Triangle& triangle, std::uint32_t number) {
    return {corner_of(triangle, 0, number), corner_of(triangle, 1, 0), corner_of(triangle, 2, 0)};
}

/// One that is none has a box that every ray leaves before it enters it.
struct Child {
    Float4 centre = all(0), half = all(-std::numeric_limits<float>::max());
    std::uint32_t link = TREE_NOTHING;
};

TreeNode2 packed(const Child& first, const Child& second) {
    return {with_bits(first.centre, first.link), with_bits(first.half, 0),
            with_bits(second.centre, second.link), with_bits(second.half, 0)};
}

Child child_of(const Load& load, const BinaryNode& node, std::uint32_t inner_before) {
    const auto leaf = TREE_LEAF | (node.link * TREE_LEAF_MOST + node.count - 1);
    const Box box = load.padding.pad(node);
    const Float4 centre = box.low * 0.5f + box.high * 0.5f;
    const Float4 half = max(box.high - centre, centre - box.low) + all(2 * load.padding.margin());
    return {centre, half, node.count > 0 ? leaf : inner_before};
}

/// Where the root is not an inner node.
TreeNode2 lone_root(const Load& load) {
    if (load.binary.nodes.empty()) return packed(Child{}, Child{});
    return packed(child_of(load, load.binary.nodes[0], 0), Child{});
}

}  // namespace

Tree pack2(const Load& load) {
    const auto& nodes = load.binary.nodes;
    for (const BinaryNode& node : nodes) check_leaf(node.count, TREE_LEAF_MOST);
    Tree tree;
    tree.nodes2.resize(std::max<std::size_t>(1, nodes.size() / 2));
    tree.triangles.resize(load.binary.numbers.size());
    if (nodes.size() < 2) tree.nodes2[0] = lone_root(load);
    const auto before = count_inner_before(nodes);
    constexpr std::size_t chunk = 1u << 12;
    load.crew.for_chunks(nodes.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (nodes[i].count > 0) continue;
            const std::size_t left = i + 1, right = i + nodes[i].link;
            tree.nodes2[before[i]] = packed(child_of(load, nodes[left], before[left]),
                                            child_of(load, nodes[right], before[right]));
        }
    });
    load.crew.for_chunks(tree.triangles.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t number = load.binary.numbers[i];
            tree.triangles[i] = packed(load.triangles[number], number);
        }
    });
    return tree;
}

}  // namespace ptb::tree
