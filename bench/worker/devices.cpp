#include "bench/worker/devices.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/measure/nvml.h"
#include "bench/worker/icd.h"
#include "core/ocl/device.h"

namespace ptb {
namespace {

/// Loaders pass over a driver that they cannot load without a word.
void check_loads(const Icd& icd) {
    const std::string library = icd.library.substr(0, icd.library.find_last_not_of(" \t\r\n") + 1);
    if (::dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL) == nullptr) throw std::runtime_error(::dlerror());
}

std::string set_in_environment(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// Where PoCL keeps what it compiled: the first of these that is set.
std::filesystem::path pocl_cache() {
    if (const auto folder = set_in_environment("POCL_CACHE_DIR"); !folder.empty()) return folder;
    if (const auto caches = set_in_environment("XDG_CACHE_HOME"); !caches.empty())
        return caches + "/pocl/kcache";
    if (const auto home = set_in_environment("HOME"); !home.empty()) return home + "/.cache/pocl/kcache";
    return "/tmp/pocl/kcache";
}

/// PoCL has no device where it cannot write, and does not say so.
void check_pocl_cache(const Icd& icd) {
    if (icd.library.find("pocl") == std::string::npos) return;
    const std::filesystem::path cache = pocl_cache();
    std::error_code error;
    std::filesystem::create_directories(cache, error);
    if (!error && ::access(cache.c_str(), W_OK | X_OK) != 0) error.assign(errno, std::generic_category());
    if (!error) return;
    throw std::runtime_error(
        fmt::format("PoCL cannot write its cache \"{}\": {}; set POCL_CACHE_DIR to a folder "
                    "that can be written",
                    cache.string(), error.message()));
}

}  // namespace

std::vector<DeviceInfo> probe_devices() {
    auto devices = ocl::query_devices();
    for (DeviceInfo& device : devices) describe_board(device);
    if (!devices.empty()) return devices;
    for (const Icd& icd : find_icds()) {
        check_loads(icd);
        check_pocl_cache(icd);
    }
    throw std::runtime_error("it has no device here");
}

}  // namespace ptb
