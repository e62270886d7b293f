#pragma once

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

}  // namespace ptb
