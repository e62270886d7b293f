#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/record/record.h"
#include "core/ocl/device.h"

namespace ptb {

/// Measures what a device can do at most, with kernels/probe/peaks.cl and the method of a case: rates of
/// multiply-adds, roots and divisions, of reads from global and constant memory, and the time of a launch
/// that does nothing; about half a second each. What cannot be measured says why. `timer` is "auto", "event"
/// or "host"; kernels are from `kernel_dir`, or the embedded ones; `told` hears which is next.
std::vector<Peak> measure_peaks(const ocl::Device& device, const std::string& timer,
                                const std::string& kernel_dir,
                                const std::function<void(const std::string&)>& told);

}  // namespace ptb
