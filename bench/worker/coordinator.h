#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/worker/device_worker.h"
#include "bench/worker/forecast.h"

namespace ptb {

/// Hears what happens in a run.
class RunObserver {
  public:
    virtual ~RunObserver() = default;
    virtual void started(std::size_t /*index*/, const Case&) {}
    virtual void progressed(std::size_t /*index*/, const Case&, const Response&) {}
    virtual void finished(std::size_t /*index*/, const Record&) {}
};

/// A picture that a case writes, unless one of a higher rank has done so.
struct ImageFile {
    std::string path;
    std::size_t rank = 0;
};

/// What to run: device-major cases, and the picture to write for some of them.
struct RunPlan {
    MeasureOptions measure;
    double max_total_time_s = 0;  ///< 0: no budget
    std::vector<DeviceInfo> devices;
    std::vector<Case> cases;
    std::map<Case, ImageFile> image_files;
};

/// A record, and the picture that came with it.
struct Measured {
    Record record;
    std::optional<Image> picture;
};

/// What answers a request to run a case, or the record that says why nothing does.
Measured ask_with_picture(DeviceWorker& worker, const Request& request, const Channel::Progress& progress,
                          const Stopped& enough = {});
Record ask(DeviceWorker& worker, const Request& request, const Channel::Progress& progress);

/// What a worker's device can do at most, or why nobody knows.
DevicePeaks ask_peaks(DeviceWorker& worker, const std::string& device);

/// Measures a case of several devices that make one picture, whose kernel `validated` found right on the
/// first of them.
using MeasureShared = std::function<Measured(const Case& c, const std::vector<DeviceInfo>& devices,
                                             Record validated, const Channel::Progress& progress)>;

/// Seconds since any fixed moment.
using SecondsNow = std::function<double()>;
double steady_seconds();

/// Drives workers through a plan, one worker at a time, but where cases say otherwise. Whatever happens to a
/// worker, each planned case ends as exactly one record. The budget counts from construction.
class Coordinator {
  public:
    Coordinator(RunPlan plan, OpenChannel open, Stopped stopped, SecondsNow now_s = steady_seconds,
                MeasureShared shared = {});

    /// Asks each device what a pixel sample of each (kernel, scene, path length, lanes) costs.
    Forecast estimate();
    /// The same, until a quarter of the budget is gone.
    Forecast estimate_within_budget();

    /// Asks each device what it can do at most.
    std::vector<DevicePeaks> peaks();

    /// Runs the plan in its order; `observers` hear of each case. Under a budget devices have equal shares of
    /// what those before them have left; what is not forecast is asked before its first case, and what is
    /// measured makes forecasts better.
    std::vector<Record> run(Forecast forecast, const std::vector<RunObserver*>& observers);

    /// Pictures that were not written, and workers that were given up: "no picture of pocl:0: disk full".
    const std::vector<std::string>& remarks() const { return remarks_; }

    /// Whether there is a device whose worker did not start, or may be left behind.
    bool has_given_up() const;

  private:
    DeviceWorker& worker_of(const std::string& device);
    Forecast estimated(const Stopped& enough);
    void estimate(const Case& c, Forecast& forecast);
    void share_budget(std::size_t index);
    std::optional<double> budget_left_s() const;
    std::string not_to_try(const Case& c, const Forecast& forecast) const;
    Request run_request(std::size_t index) const;
    bool wants_picture(const Case& c) const;
    void keep_picture(const Case& c, const Measured& measured);
    Record run_case(std::size_t index, const Forecast& forecast, const Channel::Progress& progress);
    Measured measured(std::size_t index, const Channel::Progress& progress);
    Measured shared(std::size_t index, const Channel::Progress& progress);
    const DeviceInfo& info_of(const std::string& device) const;
    std::vector<Case> with_companions(const Case& c) const;
    void run_beside_others(std::size_t index, const Channel::Progress& progress);
    std::vector<Measured> at_once(std::vector<Request> requests, const Channel::Progress& progress);
    void close_live();

    RunPlan plan_;
    Stopped stopped_;
    SecondsNow now_s_;
    double end_s_, share_end_s_;      ///< of the budget, and of what the device at hand has of it
    std::vector<double> reserved_s_;  ///< for each case, one sample of each later one of its device
    std::set<CostKey> asked_;         ///< for an estimate
    std::map<std::string, DeviceWorker> workers_;
    DeviceWorker* live_ = nullptr;
    MeasureShared shared_;
    std::map<Case, Measured> beside_others_;      ///< measured together with a case before
    std::map<std::string, std::size_t> written_;  ///< ranks of the pictures, by their paths
    std::vector<std::string> remarks_;
};

}  // namespace ptb
