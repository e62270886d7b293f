#include "tests/support/rays.h"

#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace ptb {
namespace {

template <class Row>
cl::Buffer buffer_of(const ocl::Device& device, std::span<const Row> rows) {
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, rows.size_bytes(),
            const_cast<Row*>(rows.data())};
}

std::string options_of(const ocl::Device& device, const Tree& tree) {
    return fmt::format("-cl-std=CL1.2 -DSCENE_TREE={} -DTREE_STACK={}{}{}", tree.nodes8.empty() ? 2 : 8,
                       (tree.facts.stack_most / 128 + 1) * 128,
                       tree.nodes2q.empty() ? "" : " -DTREE_QUANTISED",
                       device.info.type == "CPU" ? " -DENGINE_ALONE" : "");
}

}  // namespace

RayList::RayList(const ocl::Device& device, const Tree& tree, const std::string& more_options,
                 const std::string& kernel_dir)
    : device_(device),
      program_(ocl::build(device, kernel_source("rays/rays.cl", kernel_dir),
                          options_of(device, tree) + more_options)),
      counted_(device, program_) {
    tree_ = tree_buffers(device, tree);
    grid_ = tree.grid;
}

std::vector<ListedHit> RayList::met(std::span<const ListedRay> rays, bool any) {
    ask(rays);
    meet(any);
    return answers();
}

void RayList::ask(std::span<const ListedRay> rays) {
    count_ = static_cast<cl_uint>(rays.size());
    asked_ = buffer_of(device_, rays);
    answers_ = cl::Buffer(device_.context, CL_MEM_WRITE_ONLY, count_ * sizeof(ListedHit));
}

LaunchTimes RayList::meet(bool any) {
    const cl_uint run = device_.info.type == "CPU" ? 256 : 1;
    cl::Kernel kernel(program_.program, any ? "rays_see" : "rays_meet");
    counted_.give(kernel);
    cl_uint i = 0;
    const auto give = [&](const auto& argument) { kernel.setArg(i++, argument); };
    give(tree_[0]), give(tree_[1]), give(grid_), give(asked_), give(answers_), give(cl_uint{0}), give(count_),
        give(run);
    const cl::NDRange group = run > 1 ? cl::NDRange(1) : cl::NullRange;  // PoCL compiles once a size
    cl::Event event;
    device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange((count_ + run - 1) / run), group,
                                       nullptr, &event);
    device_.queue.finish();
    return times_of({event}, device_).front();
}

std::vector<ListedHit> RayList::answers() const {
    std::vector<ListedHit> hits(count_);
    device_.queue.enqueueReadBuffer(answers_, CL_TRUE, 0, hits.size() * sizeof(ListedHit), hits.data());
    return hits;
}

std::optional<Counts> RayList::counts() {
    const auto counts = counted_.read();
    counted_.clear();
    return counts;
}

ListedRay make_ray(const std::array<double, 3>& origin, const std::array<double, 3>& direction) {
    const auto& [x, y, z] = direction;
    const double length = std::sqrt(x * x + y * y + z * z);
    const auto f = [](double value) { return static_cast<float>(value); };
    return {{f(origin[0]), f(origin[1]), f(origin[2]), std::bit_cast<float>(TREE_NOTHING)},
            {f(x / length), f(y / length), f(z / length), std::numeric_limits<float>::max()}};
}

}  // namespace ptb
