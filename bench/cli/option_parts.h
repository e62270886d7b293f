#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bench/cli/options.h"

namespace ptb {

// Groups of flags that several commands have.

inline constexpr const char* devices_help =
    "all, cpu, gpu, accelerator, 0, 0:1, a key, /regex/, or some of them between commas; repeatable";

/// A list fed by repeating the flag; brackets and commas in it are left alone.
void list_option(CLI::App& app, const std::string& flags, std::vector<std::string>& values, const char* help);
/// --kernel, --spp, ...; `of_run`: PTBENCH_KERNEL, ... stand in, and devices may be timed at the same time.
void add_axis_flags(CLI::App& app, std::map<std::string, std::string>& values, bool of_run);
void add_common_flags(CLI::App& app, CommonFlags& flags);

// The commands whose grammar is not in options.cpp.
void add_compare_flags(CLI::App& app, CompareFlags& flags);
void add_ab_flags(CLI::App& app, AbFlags& flags);
void add_tune_flags(CLI::App& app, TuneFlags& flags);
void add_doctor_flags(CLI::App& app, DoctorFlags& flags);
void add_report_flags(CLI::App& app, ReportFlags& flags);

}  // namespace ptb
