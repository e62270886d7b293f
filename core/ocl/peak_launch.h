#pragma once

#include <string>
#include <vector>

#include "core/ocl/program.h"

namespace ptb::ocl {

/// One launch of a kernel that does one thing many times, and what it must leave in each work-item's place.
struct PeakLaunch {
    cl::Kernel kernel;
    std::uint64_t items;
    int per_group;
    double amount;  ///< operations or bytes; 0: the launch alone is the work
    double result = 0, tolerance = 0;
};

/// Prepares the kernels of kernels/probe/peaks.cl for a device. All throw Error.
class PeakLaunches {
  public:
    /// Kernels are from `kernel_dir`, or the embedded ones. Keeps a reference.
    PeakLaunches(const Device& device, const std::string& kernel_dir);

    PeakLaunch fma();  ///< multiply-adds; each counts as two operations
    PeakLaunch root();
    PeakLaunch division();
    PeakLaunch global();    ///< bytes read, each once, from more memory than caches hold
    PeakLaunch constant();  ///< bytes read by work-items, all the same ones
    PeakLaunch nothing();

    /// What is wrong in what it left, or nothing.
    std::string wrong_result(const PeakLaunch& launch) const;

  private:
    cl::Buffer buffer(std::uint64_t bytes) const;
    cl::Buffer ones(std::uint64_t count) const;
    PeakLaunch prepared(const char* kernel, double amount) const;
    PeakLaunch arithmetic(const char* kernel, int operations, cl_uint steps,
                          double (*after)(double x, double steps)) const;

    const Device& device_;
    int lanes_, per_group_;
    std::uint64_t items_;
    Program program_;
    std::vector<float> starts_;
    cl::Buffer out_, starts_buffer_, data_, table_;
};

}  // namespace ptb::ocl
