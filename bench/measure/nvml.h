#pragma once

#include <memory>
#include <string>

#include "bench/record/record.h"
#include "core/ocl/device_info.h"

namespace ptb {

inline constexpr auto nvml_library = "libnvidia-ml.so.1";

/// One GPU as NVIDIA's Management Library knows it. The library is loaded now, so that no machine needs it.
class NvmlGpu {
  public:
    /// @param uuid  32 hexadecimal digits. Throws std::runtime_error with the reason, as methods do.
    NvmlGpu(const std::string& uuid, const std::string& library);
    double joules() const;  ///< since some moment

    /// What it tells of the board goes into `device`; the rest stays as it is.
    void describe(DeviceInfo& device) const;
    /// At this moment, as far as it tells.
    GpuState state() const;

  private:
    class Library;
    std::shared_ptr<const Library> nvml_;
    void* gpu_ = nullptr;
};

/// The GPU that this device is, or nothing where NVML does not know it.
std::shared_ptr<const NvmlGpu> nvml_gpu(const DeviceInfo& device, const std::string& library = nvml_library);

/// Adds what NVML tells of a device's board: serial number, ECC, clocks, power limit.
void describe_board(DeviceInfo& device, const std::string& library = nvml_library);

}  // namespace ptb
