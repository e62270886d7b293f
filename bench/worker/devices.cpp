#include "bench/worker/devices.h"

#include <stdexcept>

#include <dlfcn.h>

#include "bench/worker/icd.h"
#include "core/ocl/device.h"

namespace ptb {
namespace {

/// Loaders pass over a driver that they cannot load without a word.
void check_loads(const Icd& icd) {
    const std::string library = icd.library.substr(0, icd.library.find_last_not_of(" \t\r\n") + 1);
    if (::dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL) == nullptr) throw std::runtime_error(::dlerror());
}

}  // namespace

std::vector<DeviceInfo> probe_devices() {
    auto devices = ocl::query_devices();
    if (!devices.empty()) return devices;
    for (const Icd& icd : find_icds()) check_loads(icd);
    throw std::runtime_error("it has no device here");
}

}  // namespace ptb
