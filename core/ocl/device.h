#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/ocl/device_info.h"
#include "core/ocl/opencl.h"

namespace ptb::ocl {

/// A device with a context and an in-order profiling queue of its own.
struct Device {
    DeviceInfo info;
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;
};

/// The devices of every platform that this process' loader finds, in the loader's order. Empty when there is
/// no platform at all. Throws Error when a platform answers nonsense.
std::vector<DeviceInfo> query_devices();

/// Opens the device with this key. Throws Error, or std::runtime_error when no device has the key.
Device open_device(const std::string& key);

/// Whether this device silently drops what loops of a work-item do after a number of turns: Mesa's llvmpipe,
/// after 65535, which shows as missing samples.
bool bounds_loops(const DeviceInfo& info);

/// Turns that all loops of a work-item together may take on this device.
std::uint64_t loop_limit(const DeviceInfo& info);

/// Runs `call`, turning the bindings' exceptions into Error with the arguments and the device's name.
template <class Call>
auto checked(const std::string& arguments, const std::string& device, Call&& call);

}  // namespace ptb::ocl

#include "core/ocl/checked.inl"
