#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bench/record/record.h"
#include "bench/report/published.h"

namespace ptb {

inline constexpr auto to_stdout = "-";

/// Formats and where they go: {"csv", "times.csv"}.
using Destinations = std::vector<std::pair<std::string, std::string>>;

/// Those that have a destination.
Destinations asked_for(const Destinations& all);

/// Throws UsageError for what cannot be written, and when several ask for stdout.
void check_asked(const Destinations& asked);
/// Throws UsageError for two formats in one file: the second would overwrite the first.
void refuse_shared_files(const Destinations& files);
bool takes_stdout(const Destinations& asked);

/// A run and the folder of its result file, where its pictures are.
struct StoredRun {
    ResultFile result;
    std::filesystem::path folder;
    std::string name{};  ///< among several, as `names_of` gives it
};

/// Of each file the part of its path that is not in all others' too, between what they begin and end with:
/// "nvidia/h100" of archive/nvidia/h100/result.json. Empty for a single one.
std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files);

/// "html" shows several runs, any other format one: "json", "csv", "csv-samples", "md", or that of another
/// tool.
std::string text_in(const std::string& format, const std::vector<StoredRun>& runs,
                    const PublishedTable& published);

/// To a file, whole or not at all, or to stdout. Throws std::runtime_error.
void write_to(const std::string& destination, const std::string& text);

}  // namespace ptb
