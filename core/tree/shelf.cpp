#include "core/tree/shelf.h"

namespace ptb {

std::shared_ptr<const Tree> TreeShelf::tree(std::span<const Triangle> triangles, TreeLayout layout,
                                            const TreeSettings& settings, int threads) {
    const TreeKey key = tree_key(triangles, layout, settings);
    const std::lock_guard lock(mutex_);
    if (kept_ && kept_->key == key) return kept_->tree;
    kept_.reset();  // before the next one takes its memory
    kept_ = {key, std::make_shared<const Tree>(build_tree(triangles, layout, settings, threads))};
    return kept_->tree;
}

}  // namespace ptb
