#include "bench/worker/devices.h"

#include "core/ocl/device.h"

namespace ptb {

std::vector<DeviceInfo> probe_devices() { return ocl::query_devices(); }

}  // namespace ptb
