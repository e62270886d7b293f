#pragma once

#include <string>
#include <vector>

#include "bench/cli/options.h"
#include "bench/worker/probe.h"

namespace ptb {

// The commands; each returns an exit code. A user's mistake is a UsageError.
int run_command(const Options& options, const std::vector<std::string>& argv);
int fleet_command(const Options& options, const std::vector<std::string>& argv);
int confirm_command(const Options& options);
int list_command(const Options& options);
int render_command(const Options& options);
int compare_command(const Options& options);
int ab_command(const Options& options, const std::vector<std::string>& argv);
int tune_command(const Options& options);
int doctor_command(const Options& options);
int report_command(const Options& options);
int worker_command_line(const Options& options);

/// How workers of this run are started.
WorkerLaunch worker_launch(const CommonFlags& flags);

/// The devices of this machine, or of the launcher's. Watches for interruption from then on; throws
/// Interrupted.
DeviceList find_devices(const CommonFlags& flags);

/// Whether there is any device to use.
bool any_usable(const DeviceList& list);

/// One line for a user without any device: what was found, and what to install.
std::string no_device_text(const DeviceList& list);

}  // namespace ptb
