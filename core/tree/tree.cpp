#include "core/tree/tree.h"

#include "core/tree/facts.h"
#include "core/tree/leaves.h"
#include "core/tree/pack.h"
#include "core/tree/plane_grid.h"
#include "core/tree/reinsertion.h"

namespace ptb {
namespace {

Tree packed(const tree::Load& load, TreeLayout layout) {
    switch (layout) {
        case TreeLayout::bvh2:
            return pack2(load);
        case TreeLayout::bvh2q:
            return pack2q(load);
        case TreeLayout::wide8:
            break;
    }
    return pack8(load);
}

}  // namespace

std::span<const std::byte> Tree::nodes() const {
    if (!nodes8.empty()) return std::as_bytes(std::span(nodes8));
    return nodes2q.empty() ? std::as_bytes(std::span(nodes2)) : std::as_bytes(std::span(nodes2q));
}

std::span<const std::byte> Tree::leaf_rows() const {
    return nodes8.empty() ? std::as_bytes(std::span(triangles)) : std::as_bytes(std::span(blocks));
}

Tree build_tree(std::span<const Triangle> triangles, TreeLayout layout, const TreeSettings& settings,
                int threads) {
    check(settings);
    tree::Crew crew(threads);
    const tree::Soup soup(triangles, crew);
    tree::BinaryTree binary = build_binary_tree(soup, settings, crew);
    reinsert(binary, settings, crew);
    gather_leaves(binary, tree::leaf_rules(layout, settings));
    const tree::Padding padding(soup, settings);
    const tree::Load load{binary, triangles, padding, crew};
    const double growth = layout == TreeLayout::bvh2q ? tree::grid_growth(load) : 1;
    const bool coarse = growth > 1 && growth >= settings.grid_growth_most;
    Tree built = packed(load, coarse ? TreeLayout::bvh2 : layout);
    built.facts = tree::facts_of(built, triangles.size(), settings);
    built.facts.grid_growth = coarse ? 1 : growth;
    return built;
}

}  // namespace ptb
