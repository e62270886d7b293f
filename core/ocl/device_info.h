#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ptb {

/// One OpenCL device, as far as a result's reader cares.
struct DeviceInfo {
    std::string key;                           ///< "pocl:0": platform and index in it
    int platform_index = 0, device_index = 0;  ///< position in `ptbench list`
    std::string icd;                           ///< the .icd file it was found through
    std::string platform, platform_version;
    std::string name, vendor, type;  ///< type: "CPU", "GPU", "accelerator", "other"
    std::string version, driver_version, c_version, uuid;
    int compute_units = 0, clock_mhz = 0, native_float_width = 0, default_lanes = 1;
    std::uint64_t global_bytes = 0, max_alloc_bytes = 0, constant_bytes = 0, local_bytes = 0;
    std::uint64_t max_work_group = 0;
    std::vector<std::uint64_t> max_work_item_sizes;
    std::uint64_t timer_resolution_ns = 0;
    bool images = false, profiling = true;
    std::string pci;     ///< "0000:3b:00.0", or empty
    std::string node{};  ///< of a fleet, or empty
    // What the vendor's management library tells of the board, or nothing.
    std::string serial, vbios;
    std::optional<bool> ecc;
    std::optional<int> max_clock_mhz, max_memory_clock_mhz;
    std::optional<double> power_limit_w;
    std::string excluded;  ///< why it is not used ("the same device as ..."), or empty
    bool operator==(const DeviceInfo&) const = default;
};

}  // namespace ptb
