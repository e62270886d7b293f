#pragma once

#include <filesystem>
#include <vector>

#include "bench/cli/options.h"

namespace ptb {

/// --tune-file, or the user's own; empty when there is none.
std::filesystem::path tune_file(const RunFlags& flags);

/// What `tune` stored of these devices and the config's kernels, where it still holds; says on stderr what
/// does not. Throws UsageError when the file is no such store.
std::vector<Case> stored_launches(const Options& options, const Config& config,
                                  const std::vector<DeviceInfo>& devices);

/// Those of `tuned` that the plan uses.
std::vector<Case> used_launches(const std::vector<Case>& tuned, const std::vector<Case>& planned);

}  // namespace ptb
