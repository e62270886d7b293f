#include "bench/workbench/builds.h"

#include <utility>

#include "bench/measure/clock.h"

namespace ptb {
namespace {

Build describe_build(const BuiltKernel& kernel, const ocl::KernelFacts& facts) {
    Build build;
    build.options = kernel.program.options;
    build.kernel_hash = kernel.program.kernel_hash;
    build.overridden = kernel.program.overridden;
    build.log = kernel.program.log;
    build.build_ms = kernel.build_ms;
    build.max_work_group = facts.max_work_group;
    build.preferred_multiple = facts.preferred_multiple;
    build.local_bytes = facts.local_bytes;
    build.private_bytes = facts.private_bytes;
    build.binary_bytes = facts.binary_bytes;
    build.registers = facts.log.registers;
    build.spill_store_bytes = facts.log.spill_store_bytes;
    build.spill_load_bytes = facts.log.spill_load_bytes;
    return build;
}

}  // namespace

Builds::Builds(ocl::Device device, std::string kernel_dir)
    : device_(std::move(device)), kernel_dir_(std::move(kernel_dir)) {}

std::string Builds::options(const CaseJob& job) const {
    return job.kernel->options(device_, *job.scene, job.work);
}

KernelSource Builds::source(const CaseJob& job) const {
    return kernel_source(job.kernel->file(), kernel_dir_);
}

Build Builds::source_of(const CaseJob& job) const {
    const KernelSource text = source(job);
    Build build;
    build.options = options(job);
    build.kernel_hash = text.hash;
    build.overridden = text.overridden;
    return build;
}

Build Builds::described(const CaseJob& job) {
    const CaseJob one_pixel = job.sized({1, 1}, 1);
    return describe_build(built(one_pixel, options(one_pixel)), make(one_pixel)->facts());
}

const BuiltKernel& Builds::built(const CaseJob& job, const std::string& options) {
    const std::string key = job.params.kernel + " " + options;
    const auto found = built_.find(key);
    if (found != built_.end()) return found->second;
    const KernelSource text = source(job);
    const std::int64_t begin = now_ns();
    BuiltKernel fresh{ocl::build(device_, text, options), 0};
    fresh.build_ms = seconds_since(begin) * 1e3;
    return built_[key] = fresh;
}

std::unique_ptr<Render> Builds::make(const CaseJob& job) {
    return job.kernel->make(device_, built(job, options(job)).program, *job.scene, job.work);
}

std::unique_ptr<PartRender> Builds::make_parts(const CaseJob& job) {
    return job.kernel->make_parts(device_, built(job, options(job)).program, *job.scene, job.work);
}

std::unique_ptr<Render> Builds::make_counting(const CaseJob& job) {
    return job.kernel->make(device_, built(job, options(job) + count_option).program, *job.scene, job.work);
}

}  // namespace ptb
