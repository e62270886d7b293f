#pragma once

#include <filesystem>

#include "bench/record/record.h"

namespace ptb {

/// Names the files of a run that began in another folder as they are called from `here`. `data`: of ptbench.
void see_from(const std::filesystem::path& here, ResultFile& run, const std::filesystem::path& data);

}  // namespace ptb
