#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "bench/measure/nvml.h"
#include "bench/record/record.h"
#include "core/ocl/device_info.h"

namespace ptb {

/// A counter of a device's energy that only grows, or why there is none.
struct EnergyCounter {
    std::string source;              ///< "NVML", "RAPL package-0", ...
    std::string reason;              ///< why it cannot be read, or empty
    std::function<double()> joules;  ///< since some moment; throws std::runtime_error
    double least_s = 0;              ///< shortest time over which its steps do not show
};

/// Of all CPU packages, from the kernel's powercap tree. Each may wrap around once between two readings.
EnergyCounter rapl_counter(const std::filesystem::path& powercap = "/sys/class/powercap");

/// Of the NVIDIA GPU with this UUID (32 hexadecimal digits), from a library loaded now.
EnergyCounter nvml_counter(const std::string& uuid, const std::string& library = nvml_library);

/// The one that covers this device.
EnergyCounter energy_counter(const DeviceInfo& device);

/// Integrates a counter over the timed samples of a case.
class EnergyMeter {
  public:
    using Seconds = std::function<double()>;
    /// Reads idle power now, waiting with `wait` for as long as that takes.
    EnergyMeter(EnergyCounter counter, Seconds now_s, const std::function<void(double s)>& wait);
    /// The timed samples of a case begin.
    void restart();
    /// One of so many renders has ended.
    void add(int renders);
    /// What a render of so many pixel samples took, on average since `restart`.
    Energy spent(std::uint64_t samples) const;

  private:
    double read();

    EnergyCounter counter_;
    Seconds now_s_;
    std::optional<double> idle_w_;
    int renders_ = 0;
    double begin_s_ = 0, end_s_ = 0, begin_j_ = 0, end_j_ = 0;
};

}  // namespace ptb
