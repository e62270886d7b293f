#include "bench/tune/store.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "bench/record/file.h"
#include "bench/record/host.h"
#include "bench/record/json.h"

namespace ptb {

template <>
inline constexpr auto fields<TunedKernel> = std::make_tuple(
    required("device_name", &TunedKernel::device_name), required("device_uuid", &TunedKernel::device_uuid),
    required("driver", &TunedKernel::driver), required("kernel_hash", &TunedKernel::kernel_hash),
    required("best", &TunedKernel::best), required("ties", &TunedKernel::ties),
    field("samples", &TunedKernel::samples), field("tuned_at", &TunedKernel::tuned_at));

namespace {

namespace fs = std::filesystem;

constexpr const char* schema = "ptbench.tune.v1";

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

bool same_device(const TunedKernel& a, const TunedKernel& b) {
    return a.device_name == b.device_name && a.device_uuid == b.device_uuid && a.best.device == b.best.device;
}

}  // namespace

std::string driver_of(const DeviceInfo& device) {
    return fmt::format("{} {}, {}", device.platform, device.platform_version, device.driver_version);
}

TunedKernel tuned_kernel(const DeviceInfo& device, const std::string& kernel_hash, const Case& best) {
    return {device.name, device.uuid, driver_of(device), kernel_hash, best, {}, 0, utc_now()};
}

fs::path default_tune_file() {
    const std::string config = variable("XDG_CONFIG_HOME"), home = variable("HOME");
    if (!config.empty()) return fs::path(config) / "ptbench/tune.json";
    return home.empty() ? fs::path() : fs::path(home) / ".config/ptbench/tune.json";
}

std::vector<TunedKernel> read_tuned(const fs::path& file) {
    std::vector<TunedKernel> stored;
    std::error_code error;
    const bool missing = !fs::exists(file, error) && !error;
    if (file.empty() || missing) return stored;
    const std::string origin = file.string();
    const Json json = parse_json(read_text(file), origin);
    const Where root(origin);
    if (!json.is_object() || json.value("schema", Json()) != schema)
        root.fail(fmt::format("not what `ptbench tune` stores: \"schema\" is not \"{}\"", schema));
    decode(member(json, root, "kernels"), Where(root, "kernels"), stored);
    return stored;
}

void store_tuned(const fs::path& file, const TunedKernel& fresh) {
    auto stored = read_tuned(file);
    std::erase_if(stored, [&](const TunedKernel& old) {
        return same_device(old, fresh) && old.best.kernel == fresh.best.kernel;
    });
    stored.push_back(fresh);
    std::error_code ignored;  // the next line says it better
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
    write_file(file, dump_json({{"schema", schema}, {"kernels", encode(stored)}}, 2) + "\n");
}

TunedLookup look_up(const std::vector<TunedKernel>& stored, const DeviceInfo& device,
                    const std::string& kernel, const std::string& kernel_hash) {
    TunedLookup lookup;
    for (const TunedKernel& one : stored) {
        if (one.best.kernel != kernel || one.best.device != device.key) continue;
        if (one.device_name != device.name || one.device_uuid != device.uuid)
            lookup.stale = fmt::format("tuned for {}, this is {}", one.device_name, device.name);
        else if (one.driver != driver_of(device))
            lookup.stale = fmt::format("tuned for {}, this is {}", one.driver, driver_of(device));
        else if (one.kernel_hash != kernel_hash)
            lookup.stale = fmt::format("tuned for kernel {}, this is {}", one.kernel_hash, kernel_hash);
        else
            return {&one, ""};
    }
    return lookup;
}

}  // namespace ptb
