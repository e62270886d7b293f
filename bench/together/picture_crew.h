#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/together/hand_out.h"
#include "bench/together/picture_ranges.h"
#include "bench/worker/device_worker.h"
#include "core/render/film_sums.h"

namespace ptb {

/// A picture that several devices make.
struct SharedJob {
    Case params;  ///< its device does not matter
    std::vector<DeviceInfo> devices{};
    MeasureOptions measure{};
    std::optional<RunCut> cut{};  ///< nothing: as suits the first device
};

/// As far as it got.
struct SharedPicture {
    std::optional<FilmSums> sums{};
    std::vector<DeviceParts> by{};
    std::uint64_t part_count = 0;
    double wall_s = 0;            ///< until all films were added
    double idle_parts_per_s = 0;  ///< of devices that were ready, and came too late to make anything
    std::vector<std::string> remarks{};
    std::string failure{};  ///< why it is not whole, where no device is left

    /// Throws std::runtime_error with `failure`, where there is one.
    void check() const;
    bool whole() const { return parts_made(by) == part_count; }
    /// The speed, in multiples of that of all devices together while each is making its parts; of one that
    /// made none, as it showed before.
    double efficiency() const;
    /// The same, of the fastest device alone.
    double speedup() const;
    double parts_per_s() const;
};

/// Told the share that is done, from any thread, one call at a time.
using SharedProgress = std::function<void(double done)>;

/// A worker a device, and a thread that talks to it. They make pictures of one job, of which all take parts
/// as they are done with those before; films stay on the devices to the end. A worker that dies costs what it
/// made, which is made again; one more is started on its device.
class PictureCrew {
  public:
    /// Starts and builds what is needed. Throws UsageError where a device cannot do it, std::runtime_error
    /// where none starts.
    PictureCrew(const SharedJob& job, const OpenChannel& open, const Stopped& stopped);
    ~PictureCrew();
    PictureCrew(const PictureCrew&) = delete;
    PictureCrew& operator=(const PictureCrew&) = delete;

    RunCut cut() const;
    std::uint64_t part_count() const;

    /// These parts, whoever asks first, and then others for as long as there are `more`.
    SharedPicture make(const std::vector<PartRange>& parts, const SharedProgress& progress,
                       const MoreParts& more = {});
    /// As they were made once; `by` in the job's order of devices.
    SharedPicture repeat(const std::vector<DeviceParts>& by, const SharedProgress& progress);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ptb
