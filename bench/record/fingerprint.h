#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// What two runs must share for their times to be of the same thing: a fact's name and its value. Devices and
/// drivers, the CPU and how much of it may be used, ptbench itself, the texts of scenes and kernels, and
/// options but those of patience (timeout, budget) and of where kernels lie.
using RunFingerprint = std::map<std::string, std::string>;

/// "kernel pt": "9f86d081884c7d65", "driver of pocl:0": "3.1", "option samples": "5", ...
RunFingerprint fingerprint_of(const ResultFile& run);

/// Of a scene's content, as the run had it; empty where it does not say.
std::string scene_hash_of(const RunInfo& run, const std::string& scene);

/// Its part that a run knows before it has looked at the machine: ptbench, options, scenes.
RunFingerprint asked_of(const RunInfo& run);

/// One text a fact that differs: "cpu: A, here B" with `there` and `here` as names of the sides. Kernels that
/// one side has not built are no difference.
std::vector<std::string> differences(const RunFingerprint& a, const std::string& there,
                                     const RunFingerprint& b, const std::string& here);

}  // namespace ptb
