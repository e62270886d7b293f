#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// A timed case as other tools see it.
struct Passed {
    Record record;
    std::string name;              ///< "NVIDIA H200: pt thesis 64x64 spp 4 length 128"; no other case's
    std::vector<double> times_ns;  ///< of one render, one a sample that counts; at least one
    /// Of all pixels, where it has an efficiency.
    std::optional<Noise> noise() const;
};
std::vector<Passed> passed(const ResultFile& result);

std::string passed_name(const ResultFile& result, const Record& record);

}  // namespace ptb
