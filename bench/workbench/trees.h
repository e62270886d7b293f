#pragma once

#include <map>
#include <memory>
#include <optional>

#include "bench/record/record.h"
#include "bench/workbench/case_job.h"

namespace ptb {

/// The trees that jobs search on one device, clocked when they are built. Asked first for whatever it is, so
/// that nothing else builds one unseen.
class Trees {
  public:
    /// Of a job's tree, which is built unless the scene's last one was the same; nothing where it searches
    /// none. Throws as build_tree does.
    std::optional<TreeRecord> of(const CaseJob& job, const ocl::Device& device);

  private:
    struct Built {
        std::weak_ptr<const Tree> tree;  ///< the scene keeps it
        double ms = 0;
    };
    std::map<const Scene*, Built> last_;
};

}  // namespace ptb
