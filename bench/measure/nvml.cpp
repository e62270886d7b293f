#include "bench/measure/nvml.h"

#include <array>
#include <optional>
#include <stdexcept>

#include <dlfcn.h>
#include <fmt/format.h>

namespace ptb {
namespace {

using Code = int;
constexpr Code success = 0;
using Gpu = void*;
constexpr int sm_clock = 1, memory_clock = 2, gpu_sensor = 0;

/// Why a clock is lower than it could be; being idle is no reason.
struct ThrottleReason {
    unsigned long long bit;
    const char* name;
};
constexpr std::array throttle_reasons{
    ThrottleReason{0x2, "application clocks"}, ThrottleReason{0x4, "power cap"},
    ThrottleReason{0x8, "hardware slowdown"},  ThrottleReason{0x10, "sync boost"},
    ThrottleReason{0x20, "software thermal"},  ThrottleReason{0x40, "hardware thermal"},
    ThrottleReason{0x80, "power brake"},       ThrottleReason{0x100, "display clocks"},
};

/// 32 digits -> "GPU-8-4-4-4-12".
std::string nvml_uuid(const std::string& hex) {
    if (hex.size() != 32) throw std::runtime_error("this driver does not tell the GPU's UUID");
    return fmt::format("GPU-{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4),
                       hex.substr(16, 4), hex.substr(20));
}

}  // namespace

/// The library while it is in use.
class NvmlGpu::Library {
  public:
    explicit Library(const std::string& file) : library_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        if (!library_) throw std::runtime_error(fmt::format("cannot load NVML: {}", ::dlerror()));
        call<Code()>("nvmlInit_v2");
    }
    ~Library() {
        if (auto* const shutdown = ::dlsym(library_.get(), "nvmlShutdown"))
            reinterpret_cast<Code (*)()>(shutdown)();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    template <class Function, class... Arguments>
    void call(const char* name, Arguments... arguments) const {
        auto* const function = reinterpret_cast<Function*>(::dlsym(library_.get(), name));
        if (function == nullptr) throw std::runtime_error(fmt::format("this NVML has no {}", name));
        if (const Code code = function(arguments...); code != success)
            throw std::runtime_error(fmt::format("{} says {} ({})", name, code, meaning(code)));
    }

    /// What a call tells through its last parameter, or nothing where it tells nothing.
    template <class Value, class... Arguments>
    std::optional<Value> told(const char* name, Arguments... arguments) const {
        Value value{};
        auto* const function =
            reinterpret_cast<Code (*)(Arguments..., Value*)>(::dlsym(library_.get(), name));
        if (function == nullptr || function(arguments..., &value) != success) return std::nullopt;
        return value;
    }

    /// Whether memory is checked now; what is to be after the next start is left out.
    std::optional<bool> ecc(Gpu gpu) const {
        int now = 0, later = 0;
        auto* const function =
            reinterpret_cast<Code (*)(Gpu, int*, int*)>(::dlsym(library_.get(), "nvmlDeviceGetEccMode"));
        if (function == nullptr || function(gpu, &now, &later) != success) return std::nullopt;
        return now != 0;
    }

    /// The same for text.
    std::string text(const char* name, Gpu gpu) const {
        std::array<char, 96> text{};
        auto* const function =
            reinterpret_cast<Code (*)(Gpu, char*, unsigned)>(::dlsym(library_.get(), name));
        if (function == nullptr || function(gpu, text.data(), unsigned{text.size()}) != success) return "";
        text.back() = '\0';
        return text.data();
    }

  private:
    std::string meaning(Code code) const {
        auto* const text = ::dlsym(library_.get(), "nvmlErrorString");
        return text == nullptr ? "no text" : reinterpret_cast<const char* (*)(Code)>(text)(code);
    }

    struct Close {
        void operator()(void* library) const { ::dlclose(library); }
    };
    std::unique_ptr<void, Close> library_;
};

NvmlGpu::NvmlGpu(const std::string& uuid, const std::string& library)
    : nvml_(std::make_shared<Library>(library)) {
    nvml_->call<Code(const char*, Gpu*)>("nvmlDeviceGetHandleByUUID", nvml_uuid(uuid).c_str(), &gpu_);
}

double NvmlGpu::joules() const {
    unsigned long long millijoules = 0;
    nvml_->call<Code(Gpu, unsigned long long*)>("nvmlDeviceGetTotalEnergyConsumption", gpu_, &millijoules);
    return static_cast<double>(millijoules) * 1e-3;
}

void NvmlGpu::describe(DeviceInfo& device) const {
    device.serial = nvml_->text("nvmlDeviceGetSerial", gpu_);
    device.vbios = nvml_->text("nvmlDeviceGetVbiosVersion", gpu_);
    device.ecc = nvml_->ecc(gpu_);
    if (const auto mhz = nvml_->told<unsigned>("nvmlDeviceGetMaxClockInfo", gpu_, sm_clock))
        device.max_clock_mhz = static_cast<int>(*mhz);
    if (const auto mhz = nvml_->told<unsigned>("nvmlDeviceGetMaxClockInfo", gpu_, memory_clock))
        device.max_memory_clock_mhz = static_cast<int>(*mhz);
    if (const auto milliwatts = nvml_->told<unsigned>("nvmlDeviceGetEnforcedPowerLimit", gpu_))
        device.power_limit_w = *milliwatts * 1e-3;
}

GpuState NvmlGpu::state() const {
    GpuState state;
    if (const auto mhz = nvml_->told<unsigned>("nvmlDeviceGetClockInfo", gpu_, sm_clock))
        state.clock_mhz = static_cast<int>(*mhz);
    if (const auto mhz = nvml_->told<unsigned>("nvmlDeviceGetClockInfo", gpu_, memory_clock))
        state.memory_clock_mhz = static_cast<int>(*mhz);
    if (const auto celsius = nvml_->told<unsigned>("nvmlDeviceGetTemperature", gpu_, gpu_sensor))
        state.temperature_c = static_cast<int>(*celsius);
    if (const auto milliwatts = nvml_->told<unsigned>("nvmlDeviceGetPowerUsage", gpu_))
        state.power_w = *milliwatts * 1e-3;
    const auto bits = nvml_->told<unsigned long long>("nvmlDeviceGetCurrentClocksThrottleReasons", gpu_);
    for (const auto& [bit, name] : throttle_reasons)
        if (bits && (*bits & bit) != 0) state.throttle.emplace_back(name);
    return state;
}

std::shared_ptr<const NvmlGpu> nvml_gpu(const DeviceInfo& device, const std::string& library) {
    if (device.vendor.find("NVIDIA") == std::string::npos) return nullptr;
    try {
        return std::make_shared<NvmlGpu>(device.uuid, library);
    } catch (const std::runtime_error&) {
        return nullptr;  // a container may lack NVML; the energy counter's reason says why
    }
}

void describe_board(DeviceInfo& device, const std::string& library) {
    if (const auto gpu = nvml_gpu(device, library)) gpu->describe(device);
}

}  // namespace ptb
