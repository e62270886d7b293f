#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/record/record.h"
#include "bench/report/grid.h"

namespace ptb {

/// One row of a table that others published.
struct PublishedRow {
    std::string vendor, type, device;
    int spp = 0;
    double time_ms = 0;
    Size size;
    int path_length = 0;
    bool operator==(const PublishedRow&) const = default;
};

/// Times from elsewhere to put beside a run's own: the thesis' Table 1.
struct PublishedTable {
    int year = 0;
    std::string origin, kernel, scene;
    std::vector<PublishedRow> rows;
    bool operator==(const PublishedTable&) const = default;
};

/// Throws UsageError.
PublishedTable read_published(const std::filesystem::path& file);

/// The published rows, and after those of each SPP the run's own that did the same work per pixel; a time of
/// another size also as it would be if it grew with the pixels. Only the published rows when there are no
/// others.
Section published_section(const ResultFile& result, const PublishedTable& published);

}  // namespace ptb
