#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/workbench/picture_job.h"
#include "bench/workbench/picture_parts.h"
#include "bench/workbench/stopwatch.h"
#include "bench/workbench/trees.h"
#include "bench/workbench/validator.h"

namespace ptb {

/// What became of a case: its record, and the timed image where it came to that.
struct CaseResult {
    Record record;
    Image picture{};
};

/// How a case is run.
struct RunHow {
    double time_left_s = 0;
    bool validate_only = false;
    /// Whether others still measure, beside whom this device is to stay busy; empty: there are none.
    std::function<bool()> others_measure{};
};

/// One device, and what measuring a case on it takes: kernels, verdicts, a stopwatch.
class Workbench {
  public:
    /// Throws when there is no such device, or it cannot be opened.
    Workbench(const std::string& device_key, const MeasureOptions& options,
              const std::filesystem::path& data_folder);
    Workbench(const Workbench&) = delete;  // its parts know each other
    Workbench& operator=(const Workbench&) = delete;

    /// Runs one case to its record. Never throws for what a device, driver or kernel does.
    CaseResult run(const Case& params, const RunHow& how, const Stage& stage);

    /// Some samples of a case that `run` found valid; their film is checked too. Throws what goes wrong.
    Record round(const Case& params, int samples, const Stage& stage);

    /// The picture of a case, or of what its samples cost, or of what comes of it in `time_s`; see
    /// `render_picture`. Throws Unsupported for what this device cannot do, and what goes wrong.
    Rendered picture(const Case& params, Aov aov, std::optional<double> time_s, const Progress& progress);

    /// This device's parts of a picture that several make, cut into runs as one of them was (`cut`), or as
    /// suits this one. Throws Unsupported for what this device cannot do, and what goes wrong.
    std::unique_ptr<PictureParts> parts(const Case& params, const std::optional<RunCut>& cut);

    /// What the device can do at most. Throws what goes wrong.
    std::vector<Peak> peaks(const Stage& stage) const;

    /// Device time of one pixel sample of this case, ns. Throws what goes wrong.
    double estimate(const Case& params);

  private:
    CaseJob resolve(const Case& params);
    void attempt(const CaseJob& job, const RunHow& how, const Stage& stage, CaseResult& result);
    Image time(const CaseJob& job, const RunHow& how, const Stage& stage, Record& record);

    MeasureOptions options_;
    std::filesystem::path data_folder_;
    std::map<std::string, Scene> scenes_;
    Builds builds_;
    Trees trees_;
    Pace pace_;
    Validator validator_;
    Stopwatch stopwatch_;
};

}  // namespace ptb
