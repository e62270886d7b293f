#pragma once

#include <filesystem>
#include <string>

#include "bench/record/record.h"

namespace ptb {

/// The text of a result file: schema "ptbench.v1", two spaces of indentation.
std::string result_text(const ResultFile& result);

/// Writes it whole or not at all. Throws std::runtime_error with the path and the reason.
void write_result(const std::filesystem::path& file, const ResultFile& result);

/// Throws UsageError, one line, on anything but a result file of a version that is known; fields that are not
/// known are ignored.
ResultFile read_result(const std::filesystem::path& file);

}  // namespace ptb
