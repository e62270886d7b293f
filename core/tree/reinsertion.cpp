#include "core/tree/reinsertion.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <numeric>
#include <utility>

#include "core/tree/loose_tree.h"

namespace ptb::tree {
namespace {

constexpr int most_looks =
    100;  ///< that a search takes: more find hardly more, and may be as many as there are nodes

using Numbers = std::vector<std::uint32_t>;  ///< of nodes

struct Move {
    std::uint32_t node = LooseNode::none;
    std::uint32_t to = LooseNode::none;  ///< becomes its sibling
    float gain = 0;                      ///< half area of inner nodes
};

/// Looks for the best place of one node after the other.
class Search {
  public:
    explicit Search(const LooseTree& tree) : tree_(tree) {}

    /// The node's own place, of no gain, if there is no better one. Looks into the siblings' subtrees on the
    /// way up to the root.
    Move best_move(std::uint32_t node) {
        looks_left_ = most_looks;
        waiting_.clear();
        best_ = {node, LooseNode::none, 0};
        box_ = tree_[node].box;
        area_ = tree_[node].half_area;
        const std::uint32_t parent = tree_[node].parent;
        float gain = tree_[parent].half_area;  // which goes
        Box without = nothing;                 // what an ancestor holds once the node is gone
        for (std::uint32_t below = node, ancestor = parent;;
             below = std::exchange(ancestor, tree_[ancestor].parent)) {
            const std::uint32_t sibling = tree_.sibling_of(below);
            look_into(sibling, gain);
            if (tree_[ancestor].parent == LooseNode::none) return best_;
            grow(without, tree_[sibling].box);
            if (ancestor == parent) continue;
            gain += tree_[ancestor].half_area - half_area(without);
            consider(ancestor, gain - tree_[ancestor].half_area);
        }
    }

  private:
    void consider(std::uint32_t to, float gain) {
        if (gain <= best_.gain) return;
        best_.to = to;
        best_.gain = gain;
    }

    bool hopeless(float gain) const { return gain - area_ <= best_.gain; }

    /// `gain` is what it gains to take the node out and to come here, without what it costs to put it in: its
    /// own area or more.
    void look_into(std::uint32_t top, float gain) {
        open(top, gain);
        for (; !waiting_.empty() && looks_left_ > 0; --looks_left_) {
            const auto [gain_below, i] = waiting_.back();
            waiting_.pop_back();
            if (hopeless(gain_below)) continue;
            const auto first = waiting_.size();
            for (const std::uint32_t child : tree_[i].child) open(child, gain_below);
            if (waiting_.size() == first + 2 && waiting_[first] > waiting_[first + 1])
                std::swap(waiting_[first], waiting_[first + 1]);  // the better one next
        }
    }

    /// To become the sibling of this node; or go below, which makes it larger.
    void open(std::uint32_t i, float gain) {
        const float here = gain - half_area(join(tree_[i].box, box_));
        consider(i, here);
        const float gain_below = here + tree_[i].half_area;
        if (!tree_[i].leaf() && !hopeless(gain_below)) waiting_.emplace_back(gain_below, i);
    }

    const LooseTree& tree_;
    Move best_;
    Box box_{};
    float area_ = 0;
    std::vector<std::pair<float, std::uint32_t>> waiting_;
    int looks_left_ = 0;
};

/// Of all candidates that gain by one, the best first.
std::vector<Move> find_moves(const LooseTree& tree, const Numbers& candidates, Crew& crew) {
    std::vector<Move> moves;
    std::mutex mutex;
    crew.for_chunks(candidates.size(), 1u << 10, [&](std::size_t begin, std::size_t end) {
        Search search(tree);
        std::vector<Move> some;
        for (std::size_t i = begin; i < end; ++i) {
            if (!tree.can_move(candidates[i])) continue;
            const Move move = search.best_move(candidates[i]);
            if (move.gain > 0) some.push_back(move);
        }
        const std::lock_guard lock(mutex);
        moves.insert(moves.end(), some.begin(), some.end());
    });
    std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
        return a.gain != b.gain ? a.gain > b.gain : a.node < b.node;
    });
    return moves;
}

/// But those that touch what a better one changed, since they were not looked for in this tree. Returns what
/// was gained, about.
double make_moves(LooseTree& tree, const std::vector<Move>& moves, int depth_most) {
    std::vector<bool> touched(tree.size() + 1, false);  // the last stands for no node: the root's parent
    const auto last = static_cast<std::uint32_t>(tree.size());
    double gain = 0;
    for (const Move& move : moves) {
        const std::array around = {move.node, tree.sibling_of(move.node), tree[move.node].parent, move.to,
                                   std::min(tree[move.to].parent, last)};
        const bool free =
            std::none_of(around.begin(), around.end(), [&](std::uint32_t i) { return touched[i]; });
        if (!free || !tree.may_move(move.node, move.to, depth_most)) continue;
        for (const std::uint32_t i : around) touched[i] = true;
        tree.move(move.node, move.to);
        gain += static_cast<double>(move.gain);
    }
    return gain;
}

/// Marks the node and those above it by a few levels, with their siblings.
void mark_around(std::vector<bool>& marked, const LooseTree& tree, std::uint32_t node) {
    constexpr int levels = 2;
    for (int i = 0; i < levels && tree[node].parent != LooseNode::none; ++i) {
        marked[node] = marked[tree.sibling_of(node)] = true;
        node = tree[node].parent;
    }
}

/// What may gain next: what could before, and what is around. Most of the tree rests after the first pass.
Numbers next_candidates(const LooseTree& tree, const std::vector<Move>& moves) {
    std::vector<bool> marked(tree.size(), false);
    for (const Move& move : moves) {
        mark_around(marked, tree, move.node);
        mark_around(marked, tree, move.to);
    }
    Numbers numbers;
    for (std::uint32_t i = 0; i < tree.size(); ++i)
        if (marked[i]) numbers.push_back(i);
    return numbers;
}

}  // namespace

void reinsert(BinaryTree& tree, const TreeSettings& settings, Crew& crew) {
    if (tree.nodes.empty() || settings.reinsertion.passes_most == 0) return;
    LooseTree loose(tree);
    tree = {};
    const double worth_it = static_cast<double>(settings.reinsertion.gain_least) * loose.inner_area();
    Numbers candidates(loose.size());
    std::iota(candidates.begin(), candidates.end(), 0u);
    for (int pass = 0; pass < settings.reinsertion.passes_most; ++pass) {
        const std::vector<Move> moves = find_moves(loose, candidates, crew);
        if (make_moves(loose, moves, settings.depth_most) <= worth_it) break;
        candidates = next_candidates(loose, moves);
    }
    tree = loose.tidy();
}

}  // namespace ptb::tree
