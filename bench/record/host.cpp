#include "bench/record/host.h"

#include <array>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "bench/record/cpus.h"
#include "bench/version.h"

namespace ptb {
namespace {

double load_of_last_minute() {
    double load = 0;
    return ::getloadavg(&load, 1) == 1 ? load : 0;
}

}  // namespace

std::string kernel_text(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::optional<double> kernel_number(const std::filesystem::path& file) {
    double value = 0;
    return std::ifstream(file) >> value ? std::optional(value) : std::nullopt;
}

std::string value_after(std::string_view text, std::string_view key, char separator) {
    while (!text.empty()) {
        const auto end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
        const auto split = line.find(separator);
        if (!line.starts_with(key) || split == std::string_view::npos) continue;
        const std::string_view value = line.substr(split + 1);
        const auto first = value.find_first_not_of(" \t\"");
        if (first == std::string_view::npos) return {};
        return std::string(value.substr(first, value.find_last_not_of(" \t\"") + 1 - first));
    }
    return {};
}

std::string cpu_model(std::string_view cpuinfo) { return value_after(cpuinfo, "model name", ':'); }

std::string os_name(std::string_view os_release) { return value_after(os_release, "PRETTY_NAME", '='); }

std::uint64_t total_memory(std::string_view meminfo) {
    const std::string kilobytes = value_after(meminfo, "MemTotal", ':');
    std::uint64_t value = 0;
    std::from_chars(kilobytes.data(), kilobytes.data() + kilobytes.size(), value);
    return value * 1024;
}

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

HostInfo host_info() {
    HostInfo info;
    utsname names{};
    if (::uname(&names) == 0) {
        info.hostname = names.nodename;
        info.kernel = fmt::format("{} {} {}", names.sysname, names.release, names.machine);
    }
    info.os = os_name(kernel_text("/etc/os-release"));
    info.cpu = cpu_model(kernel_text("/proc/cpuinfo"));
    info.cores = static_cast<int>(std::thread::hardware_concurrency());
    info.cpus_allowed = cpus_allowed();
    if (const auto quota = cpu_quota()) info.cpu_quota = quota->cpus;
    info.memory_bytes = total_memory(kernel_text("/proc/meminfo"));
    info.load_1min = load_of_last_minute();
    return info;
}

RunInfo run_info(std::vector<std::string> argv, const std::string& config, std::uint64_t seed) {
    RunInfo info;
    std::error_code unknown;
    info.argv = std::move(argv);
    info.folder = std::filesystem::current_path(unknown).string();
    info.config = config;
    info.seed = seed;
    info.tool_version = version::tool;
    info.git_sha = version::git_sha;
    info.git_dirty = version::git_dirty;
    info.compiler = version::compiler;
    info.started_at = utc_now();
    return info;
}

std::string utc_now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace ptb
