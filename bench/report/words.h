#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// Four significant digits or all before the point: "0.123", "12.34", "269815"; "-" when it is not finite.
std::string number_text(double value);

/// Milliseconds from nanoseconds.
double ms(double ns);

/// The unit of a column of times: the largest in which none of them is under 1.
struct TimeUnit {
    const char* name = "ms";
    double ns = 1e6;
    std::string title(const std::string& what) const;  ///< "time us"
    std::string text(double time_ns) const;
};
/// Of the records' medians; each must have one.
TimeUnit unit_of(const std::vector<Record>& records);

/// Half of the median's 95 % interval in percent, or "~" and the median absolute deviation when there is
/// none, or "-" with fewer than three samples.
std::string spread_text(const Statistics& statistics);

/// Of a timed record: "fastest" for the shortest time of a group; "as fast" for a stable one whose 95 %
/// interval overlaps with that one's, so that their order is not sure; else empty.
std::string mark_text(const Record& record, const Statistics& fastest);
constexpr const char* mark_note = "as fast: its 95 % interval overlaps with that of the fastest";

/// The device of a record, or an empty one when the file does not describe it.
DeviceInfo device_of(const ResultFile& result, const std::string& key);

/// What the thesis' table would call it: "NVIDIA", "AMD", "Intel", else as the driver says.
std::string vendor_name(const DeviceInfo& device);

/// The device's name, with its key in front when another device has the same name.
std::string device_label(const ResultFile& result, const std::string& key);

/// True when the record has a time that may be published.
bool timed(const Record& record);

/// Of timed records: whether the first one's median is the shorter.
bool faster(const Record& a, const Record& b);

/// Timed records with implicit work-groups: those that every device can be compared in.
std::vector<Record> comparable(const ResultFile& result);

/// Records of the same work on whichever device; a work is a case without its device.
std::map<Case, std::vector<Record>> by_work(const std::vector<Record>& records);
Case without_device(Case c);

/// Those of `axes` in which the records differ.
std::vector<std::string> varying(const std::vector<Record>& records, const std::vector<std::string>& axes);

}  // namespace ptb
