#include "bench/workbench/trees.h"

#include "bench/measure/clock.h"

namespace ptb {
namespace {

const char* layout_of(const Tree& tree) {
    if (!tree.nodes8.empty()) return "wide8";
    return tree.nodes2q.empty() ? "bvh2" : "bvh2q";
}

TreeRecord describe_tree(const Tree& tree, double build_ms) {
    const TreeFacts& facts = tree.facts;
    return {.layout = layout_of(tree),
            .triangles = facts.triangles,
            .references = facts.references,
            .nodes = facts.nodes,
            .leaves = facts.leaves,
            .bytes = facts.bytes,
            .depth = facts.depth,
            .sah_cost = facts.sah_cost,
            .build_ms = build_ms};
}

}  // namespace

std::optional<TreeRecord> Trees::of(const CaseJob& job, const ocl::Device& device) {
    const std::int64_t begin = now_ns();
    const std::shared_ptr<const Tree> tree = tree_of(*job.kernel, device, *job.scene, job.work);
    if (!tree) return std::nullopt;
    Built& last = last_[job.scene];
    if (last.tree.lock() != tree) last = {tree, seconds_since(begin) * 1e3};
    return describe_tree(*tree, last.ms);
}

}  // namespace ptb
