#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "core/tree/tree.h"

namespace ptb {

/// The tree that was built last, for who asks for the same again: a case does so several times, and so do
/// the cases of a sweep. Methods may be called from any thread.
class TreeShelf {
  public:
    /// Throws as build_tree does.
    std::shared_ptr<const Tree> tree(std::span<const Triangle> triangles, TreeLayout layout,
                                     const TreeSettings& settings, int threads);

  private:
    struct Kept {
        TreeKey key;
        std::shared_ptr<const Tree> tree;
    };
    std::mutex mutex_;
    std::optional<Kept> kept_;
};

}  // namespace ptb
