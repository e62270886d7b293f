#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// Facts of this host, from the kernel's files; what cannot be read stays empty.
HostInfo host_info();

/// The name of this host; empty where it cannot be told.
std::string host_name();

/// Facts of this program and this moment; `config` and `seed` of the run.
RunInfo run_info(std::vector<std::string> argv, const std::string& config, std::uint64_t seed);

/// "2016-05-17T09:30:00Z", now.
std::string utc_now();

/// What a file of the kernel says, or the number that it begins with; empty or nothing where it cannot be
/// read.
std::string kernel_text(const std::filesystem::path& file);
std::optional<double> kernel_number(const std::filesystem::path& file);

/// What follows `key` and `separator` on the first line that starts with `key`, without blanks and quotes.
std::string value_after(std::string_view text, std::string_view key, char separator);

/// "model name" of /proc/cpuinfo, PRETTY_NAME of os-release, and MemTotal of meminfo in bytes.
std::string cpu_model(std::string_view cpuinfo);
std::string os_name(std::string_view os_release);
std::uint64_t total_memory(std::string_view meminfo);

}  // namespace ptb
