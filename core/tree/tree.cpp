#include "core/tree/tree.h"

#include "core/tree/facts.h"
#include "core/tree/leaves.h"
#include "core/tree/pack.h"
#include "core/tree/reinsertion.h"

namespace ptb {

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
    Tree built = layout == TreeLayout::bvh2 ? pack2(load) : pack8(load);
    built.facts = tree::facts_of(built, triangles.size(), settings);
    return built;
}

}  // namespace ptb
