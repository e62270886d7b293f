#pragma once

#include <optional>
#include <string>

#include "bench/fleet/folder.h"
#include "bench/record/record.h"
#include "core/file/path_lock.h"
#include "core/input/usage_error.h"

namespace ptb {

/// Another process measures the node. Ends with exit code 2.
struct NodeInUse : UsageError {
    using UsageError::UsageError;
};

/// A node's journal, held against other writers while this lives.
class NodeClaim {
  public:
    /// Makes the folder. Throws NodeInUse where a living process of this node holds the journal.
    NodeClaim(const FleetFolder& folder, const std::string& node);

    /// What an earlier part of the node's run left, or nothing.
    const std::optional<ResultFile>& earlier() const { return earlier_; }

  private:
    PathLock lock_;
    std::optional<ResultFile> earlier_;
};

}  // namespace ptb
