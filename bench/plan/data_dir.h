#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ptb {

/// Path of this executable.
std::filesystem::path self_path();

/// The folder with `configs/` and `results/`: PTBENCH_DATA_DIR, else `../share/ptbench` beside the
/// executable's folder. Throws UsageError when it is missing.
std::filesystem::path data_dir();

/// Names of the shipped scenes and configs, sorted.
std::vector<std::string> scene_names();
std::vector<std::string> config_names();

}  // namespace ptb
