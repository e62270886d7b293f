#pragma once

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/ocl/device.h"

namespace ptb {

/// Every device that this process sees, opened.
inline std::vector<ocl::Device> all_devices() {
    std::vector<ocl::Device> devices;
    for (const DeviceInfo& info : ocl::query_devices()) devices.push_back(ocl::open_device(info.key));
    return devices;
}

/// Runs the body once a device; failures name the device.
template <class Body>
void on_every_device(Body&& body) {
    const std::vector<ocl::Device> devices = all_devices();
    ASSERT_FALSE(devices.empty()) << "no OpenCL device: is pocl-opencl-icd installed?";
    for (const ocl::Device& device : devices) {
        SCOPED_TRACE("on " + device.info.key + ", " + device.info.name);
        body(device);
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// As above, of devices that have one compiler the first: PoCL's "pthread-haswell-EPYC" and
/// "basic-haswell-EPYC".
template <class Body>
void on_every_compiler(Body&& body) {
    std::set<std::string> seen;
    on_every_device([&](const ocl::Device& device) {
        const std::string machine = device.info.name.substr(device.info.name.find('-') + 1);
        if (seen.insert(device.info.platform + machine).second) body(device);
    });
}

}  // namespace ptb
