#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/plan/case.h"

namespace ptb {

/// The file of a scene, given by name or as a file. Throws UsageError listing the scenes there are.
std::filesystem::path scene_file(const std::string& name_or_file);

/// Throws UsageError for a kernel or scene that does not exist, and for a scene file that cannot be used.
void check_names(const std::vector<Case>& cases);

}  // namespace ptb
