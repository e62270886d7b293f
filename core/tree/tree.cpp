#include "core/tree/tree.h"

#include <stdexcept>

#include <fmt/format.h>

#include "core/tree/facts.h"
#include "core/tree/pack.h"

namespace ptb {

Tree build_tree(std::span<const Triangle> triangles, TreeLayout layout, const TreeSettings& settings,
                int threads) {
    check(settings);
    tree::Crew crew(threads);
    const tree::Soup soup(triangles, crew);
    const tree::Rules rules = tree::rules_of(settings, layout);
    const tree::BinaryTree binary = build_binary_tree(soup, rules, crew);
    const tree::Padding padding(soup, settings);
    const tree::Load load{binary, triangles, padding, crew};
    Tree tree = layout == TreeLayout::bvh2 ? pack2(load) : pack8(load);
    tree.facts = facts_of(tree, triangles.size(), rules);
    return tree;
}

}  // namespace ptb
