#include <algorithm>
#include <bit>
#include <limits>

#include "core/tree/pack.h"
#include "core/tree/plane_grid.h"

namespace ptb::tree {
namespace {

constexpr std::size_t chunk = 1u << 12;

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

Child child_of(const Load& load, const BinaryNode& node, std::uint32_t link) {
    const Box box = load.padding.pad(node);
    const Float4 centre = box.low * 0.5f + box.high * 0.5f;
    const Float4 half = max(box.high - centre, centre - box.low) + all(2 * load.padding.margin());
    return {centre, half, link};
}

/// A child that is none has its planes the wrong way round.
struct QuantisedChild {
    std::uint32_t x = none, y = none, z = none, link = TREE_NOTHING;
    static constexpr std::uint32_t none = 0xffff;
};

TreeNode2q packed(const QuantisedChild& a, const QuantisedChild& b) {
    return {a.x, a.y, a.z, a.link, b.x, b.y, b.z, b.link};
}

/// Nodes of two children, each made of two of what `child` makes of a node and its link.
template <class Make>
auto pack_nodes(const Load& load, Make child) {
    const auto& nodes = load.binary.nodes;
    for (const BinaryNode& node : nodes) check_leaf(node.count, TREE_LEAF_MOST);
    const auto before = count_inner_before(nodes);
    const auto child_at = [&](std::size_t i) {
        const std::uint32_t leaf = TREE_LEAF | (nodes[i].link * TREE_LEAF_MOST + nodes[i].count - 1);
        return child(nodes[i], nodes[i].count > 0 ? leaf : before[i]);
    };
    using None = decltype(child_at(0));
    std::vector<decltype(packed(None{}, None{}))> made(std::max<std::size_t>(1, nodes.size() / 2));
    if (nodes.size() < 2) made[0] = packed(nodes.empty() ? None{} : child_at(0), None{});
    load.crew.for_chunks(nodes.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (nodes[i].count == 0) made[before[i]] = packed(child_at(i + 1), child_at(i + nodes[i].link));
    });
    return made;
}

std::vector<TreeTriangle> pack_triangles(const Load& load) {
    std::vector<TreeTriangle> triangles(load.binary.numbers.size());
    load.crew.for_chunks(triangles.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t number = load.binary.numbers[i];
            triangles[i] = packed(load.triangles[number], number);
        }
    });
    return triangles;
}

}  // namespace

Tree pack2(const Load& load) {
    Tree tree;
    tree.nodes2 = pack_nodes(
        load, [&](const BinaryNode& node, std::uint32_t link) { return child_of(load, node, link); });
    tree.triangles = pack_triangles(load);
    return tree;
}

Tree pack2q(const Load& load) {
    const PlaneGrid grid(load);
    Tree tree;
    tree.nodes2q = pack_nodes(load, [&](const BinaryNode& node, std::uint32_t link) {
        const Box box = box_of(node);
        return QuantisedChild{grid.around(box, 0), grid.around(box, 1), grid.around(box, 2), link};
    });
    tree.triangles = pack_triangles(load);
    tree.grid = grid.facts();
    return tree;
}

}  // namespace ptb::tree
