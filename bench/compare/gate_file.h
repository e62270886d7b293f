#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bench/compare/gate.h"
#include "bench/compare/row.h"
#include "bench/record/record.h"

namespace ptb {

/// What one side of a gate was.
struct GateSide {
    std::string binary, kernel_dir, config;
    bool operator==(const GateSide&) const = default;
};

/// A gate with everything its decision was made from. Schema "ptbench.ab.v1".
struct GateFile {
    RunInfo run;
    HostInfo host;
    std::vector<DeviceInfo> devices;
    GateSide base, now;
    std::uint64_t shuffle_seed = 0;
    Rules rules;
    std::vector<GateCase> cases;
    std::vector<Record> base_records, now_records;  ///< of the validation, or of what failed; one a case
    std::vector<Finding> findings;                  ///< one a case
    bool operator==(const GateFile&) const = default;
};

/// Writes it whole or not at all. Throws std::runtime_error with the path and the reason.
void write_gate(const std::filesystem::path& file, const GateFile& gate);

/// Throws UsageError, one line, on anything but a gate that can be decided again.
GateFile read_gate(const std::filesystem::path& file);
GateFile parse_gate(std::string_view text, const std::string& origin);

/// A row for each case, with the findings as they are.
std::vector<Row> rows_of(const GateFile& gate);

}  // namespace ptb
