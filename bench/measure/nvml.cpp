// NVIDIA's Management Library, as far as an energy counter goes; loaded at run time, so that no machine needs
// it.
#include <memory>
#include <stdexcept>

#include <dlfcn.h>
#include <fmt/format.h>

#include "bench/measure/energy.h"

namespace ptb {
namespace {

constexpr double least_s = 2;  ///< it advances ten times a second: 5 %

using Code = int;
constexpr Code success = 0;
using Gpu = void*;

/// The library while it is in use.
class Nvml {
  public:
    explicit Nvml(const std::string& library) : library_(::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        if (!library_) throw std::runtime_error(fmt::format("cannot load NVML: {}", ::dlerror()));
        call<Code()>("nvmlInit_v2");
    }
    ~Nvml() {
        if (auto* const shutdown = ::dlsym(library_.get(), "nvmlShutdown"))
            reinterpret_cast<Code (*)()>(shutdown)();
    }
    Nvml(const Nvml&) = delete;
    Nvml& operator=(const Nvml&) = delete;

    Gpu by_uuid(const std::string& uuid) const {
        Gpu gpu = nullptr;
        call<Code(const char*, Gpu*)>("nvmlDeviceGetHandleByUUID", uuid.c_str(), &gpu);
        return gpu;
    }

    double joules(Gpu gpu) const {
        unsigned long long millijoules = 0;
        call<Code(Gpu, unsigned long long*)>("nvmlDeviceGetTotalEnergyConsumption", gpu, &millijoules);
        return static_cast<double>(millijoules) * 1e-3;
    }

  private:
    template <class Function, class... Arguments>
    void call(const char* name, Arguments... arguments) const {
        auto* const function = reinterpret_cast<Function*>(::dlsym(library_.get(), name));
        if (function == nullptr) throw std::runtime_error(fmt::format("this NVML has no {}", name));
        if (const Code code = function(arguments...); code != success)
            throw std::runtime_error(fmt::format("{} says {} ({})", name, code, meaning(code)));
    }

    std::string meaning(Code code) const {
        auto* const text = ::dlsym(library_.get(), "nvmlErrorString");
        return text == nullptr ? "no text" : reinterpret_cast<const char* (*)(Code)>(text)(code);
    }

    struct Close {
        void operator()(void* library) const { ::dlclose(library); }
    };
    std::unique_ptr<void, Close> library_;
};

/// 32 digits -> "GPU-8-4-4-4-12".
std::string nvml_uuid(const std::string& hex) {
    if (hex.size() != 32) throw std::runtime_error("this driver does not tell the GPU's UUID");
    return fmt::format("GPU-{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4),
                       hex.substr(16, 4), hex.substr(20));
}

}  // namespace

EnergyCounter nvml_counter(const std::string& uuid, const std::string& library) {
    EnergyCounter counter;
    counter.source = "NVML";
    counter.least_s = least_s;
    try {
        const auto nvml = std::make_shared<Nvml>(library);
        const Gpu gpu = nvml->by_uuid(nvml_uuid(uuid));
        counter.joules = [nvml, gpu] { return nvml->joules(gpu); };
        counter.joules();
    } catch (const std::exception& error) {
        counter.reason = error.what();
    }
    return counter;
}

}  // namespace ptb
