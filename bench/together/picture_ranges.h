#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/plan/case.h"
#include "bench/record/fingerprint.h"
#include "bench/record/record.h"
#include "core/input/json.h"
#include "core/render/parts.h"

namespace ptb {

/// What one device made of a picture.
struct DeviceParts {
    std::string device, name, driver_version;
    std::vector<PartRange> parts{};
    double busy_s = 0;    ///< making them, by the host's clock
    double device_s = 0;  ///< by the device's

    std::uint64_t count() const { return count_of(parts); }
    double parts_per_s() const { return busy_s > 0 ? static_cast<double>(count()) / busy_s : 0; }
};

/// By all of them.
std::uint64_t parts_made(const std::vector<DeviceParts>& by);

/// Who made what of a picture: all that its bits depend on.
struct PictureRanges {
    Case params;  ///< without a device
    std::uint64_t seed = 1;
    std::string scene_hash;
    RunFingerprint facts{};  ///< of ptbench and its kernels
    RunCut cut{};
    std::uint64_t part_count = 0;
    std::string film_hash;
    std::vector<DeviceParts> devices{};
};

/// Why these are not all parts of the picture, each once, or nothing.
std::string fault_of(const PictureRanges& ranges);

/// As JSON on one line, and back. Throws UsageError.
std::string to_text(const PictureRanges& ranges);
PictureRanges parse_picture_plan(const std::string& text, const std::string& origin);
/// Throws also where they are not of every part once.
PictureRanges parse_picture_ranges(const std::string& text, const std::string& origin);

}  // namespace ptb
