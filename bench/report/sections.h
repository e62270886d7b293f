#pragma once

#include <string>
#include <vector>

#include "bench/record/record.h"
#include "bench/report/grid.h"
#include "bench/report/published.h"

namespace ptb {

/// Every time, in the order of the thesis' columns, and a column for each of `axes`.
Section times_section(const ResultFile& result, const std::vector<std::string>& axes);
/// With columns for those that its cases need.
Section times_section(const ResultFile& result);
/// The records that are in it.
std::vector<Record> shown_records(const ResultFile& result);
/// The line that time follows over SPP, and warnings where it does not.
Section fits_section(const ResultFile& result);
/// Cases without a time, those of one status and reason together.
Section problems_section(const ResultFile& result);
/// The same work on every device, and how many times faster than on the slowest. Empty for a single device.
Section devices_section(const ResultFile& result);
/// For each axis that not every table has a column for and in which cases differ: relative times by its
/// values, and why one has none.
std::vector<Section> sweep_sections(const ResultFile& result);
/// `pt` against `thesis` on each device.
Section kernels_section(const ResultFile& result);
/// Kernels that make the same work, each at the SPP that takes nearest to an equal time: noise, efficiency,
/// and that as a multiple of `base_kernel`'s.
Section efficiency_section(const ResultFile& result);
/// Noise and efficiency of every case that has them.
Section noise_section(const ResultFile& result);
/// Pictures that several devices made.
Section shared_section(const ResultFile& result);
/// Peaks, one a row.
Section peaks_section(const std::vector<DevicePeaks>& peaks);
/// Counted work and shares of the peaks: the fastest case of each device, kernel and scene.
Section limits_section(const std::vector<Record>& records);
/// The tree of each device, kernel, scene and way of building it, and what its rays met.
Section trees_section(const std::vector<Record>& records);
/// What the reader should know of the run: interruption, warnings, ICDs and devices that were not used.
Section remarks_section(const ResultFile& result);

/// Which device is how much faster, how sure that is, and what failed: in sentences.
Section summary_section(const ResultFile& result);

/// All of a report, empty sections left out.
std::vector<Section> report_sections(const ResultFile& result, const PublishedTable& published);

}  // namespace ptb
