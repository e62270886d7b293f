#include "core/ocl/device.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace ptb::ocl {

namespace {

constexpr cl_device_info cl_device_uuid_khr = 0x106A, cl_device_pci_bus_info_khr = 0x410F,
                         cl_device_pci_bus_id_nv = 0x4008, cl_device_pci_slot_id_nv = 0x4009,
                         cl_device_pci_domain_id_nv = 0x400A;

struct Found {
    DeviceInfo info;
    cl::Device device;
};

/// What `getInfo` gives as text, without the trailing zeros and blanks that some drivers leave.
template <class Object>
std::string text(const Object& object, cl_uint name) {
    std::string value;
    object.getInfo(name, &value);
    while (!value.empty() && (value.back() == '\0' || value.back() == ' ')) value.pop_back();
    return value;
}

std::string type_name(cl_device_type type) {
    if (type & CL_DEVICE_TYPE_GPU) return "GPU";
    if (type & CL_DEVICE_TYPE_CPU) return "CPU";
    if (type & CL_DEVICE_TYPE_ACCELERATOR) return "accelerator";
    return "other";
}

/// First part of a device's key: a short word for the platform.
std::string platform_slug(const std::string& platform) {
    static const std::array<std::pair<const char*, const char*>, 7> known{{
        {"Portable Computing Language", "pocl"},
        {"NVIDIA CUDA", "nvidia"},
        {"AMD Accelerated Parallel Processing", "amd"},
        {"Intel(R) OpenCL Graphics", "intel-gpu"},
        {"Intel(R) OpenCL HD Graphics", "intel-gpu"},
        {"Intel(R) OpenCL", "intel"},
        {"Oclgrind", "oclgrind"},
    }};
    for (const auto& [name, slug] : known)
        if (platform == name) return slug;
    std::string slug;
    for (const char c : platform) {
        if (std::isalnum(static_cast<unsigned char>(c)))
            slug += static_cast<char>(std::tolower(c));
        else if (!slug.empty() && slug.back() != '-')
            slug += '-';
    }
    while (!slug.empty() && slug.back() == '-') slug.pop_back();
    return slug.empty() ? "unnamed" : slug;
}

/// cl_khr_device_uuid in hexadecimal, or nothing where the device lacks it.
std::string uuid_of(const cl::Device& device) {
    if (text(device, CL_DEVICE_EXTENSIONS).find("cl_khr_device_uuid") == std::string::npos) return "";
    std::array<unsigned char, 16> bytes{};
    if (clGetDeviceInfo(device(), cl_device_uuid_khr, bytes.size(), bytes.data(), nullptr) != CL_SUCCESS)
        return "";
    std::string hex;
    for (const unsigned char byte : bytes) hex += fmt::format("{:02x}", byte);
    return hex;
}

/// What the device says of this kind, or nothing.
template <class Value>
std::optional<Value> told(const cl::Device& device, cl_device_info name) {
    Value value{};
    if (clGetDeviceInfo(device(), name, sizeof value, &value, nullptr) != CL_SUCCESS) return std::nullopt;
    return value;
}

/// "0000:3b:00.0", by cl_khr_pci_bus_info or as NVIDIA's driver tells it; nothing where there is none.
std::string pci_of(const cl::Device& device) {
    struct Address {
        cl_uint domain, bus, device, function;
    };
    const auto has = [&](const char* extension) {
        return text(device, CL_DEVICE_EXTENSIONS).find(extension) != std::string::npos;
    };
    std::optional<Address> at;
    if (has("cl_khr_pci_bus_info")) {
        at = told<Address>(device, cl_device_pci_bus_info_khr);
    } else if (has("cl_nv_device_attribute_query")) {
        const auto bus = told<cl_uint>(device, cl_device_pci_bus_id_nv);
        const auto slot = told<cl_uint>(device, cl_device_pci_slot_id_nv);  // device and function
        if (bus && slot)
            at = Address{told<cl_uint>(device, cl_device_pci_domain_id_nv).value_or(0), *bus, *slot >> 3,
                         *slot & 7};
    }
    return at ? fmt::format("{:04x}:{:02x}:{:02x}.{}", at->domain, at->bus, at->device, at->function) : "";
}

/// Rays a work-item should trace together: the SIMD width on CPUs, whose compilers keep a kernel with one ray
/// a work-item scalar (PoCL) or lose most of its width (Intel); twice that width, so that one ray's
/// arithmetic fills the waits of another's. GPUs want 1, and so does Mesa's llvmpipe, which vectorises across
/// work-items.
int default_lanes(const DeviceInfo& info) {
    if (info.type != "CPU" || info.platform == "rusticl") return 1;
    for (const int lanes : {16, 8, 4})
        if (info.native_float_width >= lanes) return 2 * lanes;
    return 1;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, int index) {
    DeviceInfo info;
    info.platform = text(platform, CL_PLATFORM_NAME);
    info.platform_version = text(platform, CL_PLATFORM_VERSION);
    info.key = fmt::format("{}:{}", platform_slug(info.platform), index);
    info.device_index = index;
    info.name = text(device, CL_DEVICE_NAME);
    info.vendor = text(device, CL_DEVICE_VENDOR);
    info.type = type_name(device.getInfo<CL_DEVICE_TYPE>());
    info.version = text(device, CL_DEVICE_VERSION);
    info.driver_version = text(device, CL_DRIVER_VERSION);
    info.c_version = text(device, CL_DEVICE_OPENCL_C_VERSION);
    info.uuid = uuid_of(device);
    info.pci = pci_of(device);
    info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
    info.clock_mhz = static_cast<int>(device.getInfo<CL_DEVICE_MAX_CLOCK_FREQUENCY>());
    info.native_float_width = static_cast<int>(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
    info.global_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.max_alloc_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.constant_bytes = device.getInfo<CL_DEVICE_MAX_CONSTANT_BUFFER_SIZE>();
    info.local_bytes = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    info.max_work_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    for (const std::size_t size : device.getInfo<CL_DEVICE_MAX_WORK_ITEM_SIZES>())
        info.max_work_item_sizes.push_back(size);
    info.timer_resolution_ns = device.getInfo<CL_DEVICE_PROFILING_TIMER_RESOLUTION>();
    info.images = device.getInfo<CL_DEVICE_IMAGE_SUPPORT>() != 0;
    info.profiling = (device.getInfo<CL_DEVICE_QUEUE_PROPERTIES>() & CL_QUEUE_PROFILING_ENABLE) != 0;
    info.default_lanes = default_lanes(info);
    return info;
}

std::vector<cl::Platform> platforms() {
    std::vector<cl::Platform> found;
    try {
        cl::Platform::get(&found);
    } catch (const cl::Error& e) {
        if (e.err() != -1001) throw;  // CL_PLATFORM_NOT_FOUND_KHR: no ICD, which is no error here
    }
    return found;
}

std::vector<Found> find_devices() {
    return checked("all platforms", "", [] {
        std::vector<Found> found;
        std::map<std::string, int> seen;  // two platforms of one name share a numbering
        int platform_index = 0;
        for (const cl::Platform& platform : platforms()) {
            std::vector<cl::Device> devices;
            try {
                platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
            } catch (const cl::Error& e) {
                if (e.err() != CL_DEVICE_NOT_FOUND) throw;
            }
            for (const cl::Device& device : devices) {
                const int index = seen[text(platform, CL_PLATFORM_NAME)]++;
                found.push_back({describe(platform, device, index), device});
                found.back().info.platform_index = platform_index;
            }
            if (!devices.empty()) ++platform_index;
        }
        return found;
    });
}

}  // namespace

std::vector<DeviceInfo> query_devices() {
    std::vector<DeviceInfo> infos;
    for (const Found& found : find_devices()) infos.push_back(found.info);
    return infos;
}

bool bounds_loops(const DeviceInfo& info) { return info.name.find("llvmpipe") != std::string::npos; }

std::uint64_t loop_limit(const DeviceInfo& info) {
    return bounds_loops(info) ? 65535 : std::numeric_limits<std::uint64_t>::max();
}

Device open_device(const std::string& key) {
    for (const Found& found : find_devices()) {
        if (found.info.key != key) continue;
        return checked("profiling queue", found.info.name, [&] {
            const cl::Context context(found.device);
            const cl_command_queue_properties properties =
                found.info.profiling ? CL_QUEUE_PROFILING_ENABLE : 0;
            return Device{found.info, found.device, context,
                          cl::CommandQueue(context, found.device, properties)};
        });
    }
    throw std::runtime_error(fmt::format("no device \"{}\" here; `ptbench list` shows what there is", key));
}

}  // namespace ptb::ocl
