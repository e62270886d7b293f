#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "bench/measure/disturbance.h"
#include "bench/measure/energy.h"
#include "bench/measure/method.h"
#include "bench/plan/config.h"
#include "bench/record/record.h"
#include "core/integrator/registry.h"
#include "core/oracle/reference.h"

namespace ptb {

/// A kernel built for one device. Shared by all cases that differ only in size, spp or launch.
struct BuiltKernel {
    ocl::Program program;
    double build_ms = 0;
};

/// One device with the kernels built and the verdicts reached on it so far.
class Workbench {
  public:
    /// Told how far a case has come: stage "build", "validate", "warmup" or "sample", and the share of it
    /// done.
    using Stage = std::function<void(const std::string& stage, double done)>;

    Workbench(const std::string& device_key, const MeasureOptions& options,
              std::filesystem::path data_folder);

    /// Runs one case to its record; `picture` gets the timed image. Never throws for what a device, driver or
    /// kernel does.
    Record run(const Case& params, double time_left_s, Image& picture, const Stage& progress);

    /// Some samples of a case that `run` found valid; their film is checked too. Throws what goes wrong.
    Record round(const Case& params, int samples, const Stage& progress);

    /// What the device can do at most. Throws what goes wrong.
    std::vector<Peak> peaks(const Stage& progress) const;

    /// Device time of one pixel sample of this case, ns. Throws what goes wrong.
    double estimate(const Case& params);

    const DeviceInfo& device() const { return device_.info; }

  private:
    struct Job;  ///< a case resolved: scene, integrator, RenderJob

    Job resolve(const Case& params);
    const Scene& scene(const std::string& name);
    Build describe_source(const Job& job) const;
    const BuiltKernel& built(const Job& job, const RenderJob& work);
    std::unique_ptr<Render> make(const Job& job, const RenderJob& work);
    const Validation& validated(const Job& job, const Stage& progress);
    void check_launch(const Job& job, Record& record);
    void attempt(const Job& job, double time_left_s, Image& picture, const Stage& progress, Record& record);
    void measure(const Job& job, double time_left_s, Image& picture, const Stage& progress, Record& record);
    Measurement take_samples(const Job& job, Render& render, double time_left_s, const Stage& progress,
                             Record& record);
    void summarize(const Measurement& measurement, Record& record) const;
    Counted counted(const Job& job, const Record& record, const Stage& progress);
    void check_film_of(const Job& job, const Film& film, Validation& validation) const;
    std::optional<Reference> stored_reference(const Job& job) const;
    Reference host_reference(const Job& job) const;

    ocl::Device device_;
    MeasureOptions options_;
    std::filesystem::path data_folder_;
    TimerWatch timer_;
    Disturbances disturbances_;
    std::optional<EnergyMeter> energy_;  ///< once a case is to be timed
    std::map<std::string, Scene> scenes_;
    std::map<std::string, BuiltKernel> built_;       ///< by kernel and options
    std::map<std::string, ocl::Program> counting_;   ///< instrumented builds, likewise
    std::map<std::string, Validation> validations_;  ///< by `Job::image_key`
    std::map<std::string, PassCutter> cutters_;      ///< by `Job::key`
    std::map<std::string, double>
        ns_per_sample_;  ///< by `Job::key`: device time, from the first small render
};

}  // namespace ptb
