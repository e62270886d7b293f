#pragma once

#include <map>
#include <memory>
#include <string>

#include "bench/record/record.h"
#include "bench/workbench/case_job.h"

namespace ptb {

/// A kernel built for one device, and what that took.
struct BuiltKernel {
    ocl::Program program;
    double build_ms = 0;
};

/// The kernels of one device, each built once: cases that differ only in size, spp or launch share theirs.
/// Methods throw what goes wrong in building.
class Builds {
  public:
    Builds(ocl::Device device, std::string kernel_dir);

    const ocl::Device& device() const { return device_; }

    /// What is known of a job's build before it succeeds.
    Build source_of(const CaseJob& job) const;
    /// What is known of it then, and of the kernel in it.
    Build described(const CaseJob& job);

    std::unique_ptr<Render> make(const CaseJob& job);
    std::unique_ptr<PartRender> make_parts(const CaseJob& job);
    /// By an instrumented build of its kernel.
    std::unique_ptr<Render> make_counting(const CaseJob& job);

  private:
    std::string options(const CaseJob& job) const;
    KernelSource source(const CaseJob& job) const;
    const BuiltKernel& built(const CaseJob& job, const std::string& options);

    ocl::Device device_;
    std::string kernel_dir_;
    std::map<std::string, BuiltKernel> built_;  ///< by kernel and options
};

}  // namespace ptb
