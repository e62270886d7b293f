#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/plan/case.h"
#include "core/ocl/device_info.h"

namespace ptb {

/// How a planned case ended. Every planned case ends as exactly one record.
enum class Status { ok, invalid, unsupported, skipped, compile, runtime, timeout, crash, unstable };

/// The work a case did, counted.
struct Work {
    std::uint64_t samples = 0;      ///< width x height x spp
    std::uint64_t segments = 0;     ///< path segments traced, counted by the kernel
    std::uint64_t shadow_rays = 0;  ///< traced beside them, to lamps or between paths of both ends
    std::uint64_t full_length_paths = 0;
    int lanes = 1;    ///< lane width that ran
    int renders = 1;  ///< full renders in one sample of time; more than one where the timer is coarse
    int passes = 0;   ///< launches of the render kernel in one sample of time
    std::int64_t longest_launch_ns = 0;
    std::uint64_t device_bytes = 0;  ///< device memory asked for
    std::optional<double> overlap;   ///< out of order: share of the launches' times that ran beside another's
    std::string film_hash{};         ///< of the timed film's bits: equal devices give equal ones
    std::uint64_t light_segments = 0;  ///< beside them too, of paths that start at lamps or are shifted
    std::uint64_t listed_rays = 0;     ///< of the segments those that are rays of a list, and no path's
    bool operator==(const Work&) const = default;
};

/// What was built, and what it took.
struct Build {
    std::string options;
    std::string kernel_hash;  ///< of the flattened text the driver saw
    bool overridden = false;  ///< text came from --kernel-dir
    double build_ms = 0;
    double upload_ms = 0;
    double readback_ms = 0;
    std::int64_t first_launch_ns = 0;  ///< first launch of this work-group size; PoCL compiles then
    std::uint64_t max_work_group = 0;  ///< CL_KERNEL_WORK_GROUP_SIZE
    std::uint64_t preferred_multiple = 0;
    std::uint64_t local_bytes = 0, private_bytes = 0;
    std::string log;
    std::optional<std::uint64_t> binary_bytes;                                    ///< of the device's program
    std::optional<std::uint64_t> registers, spill_store_bytes, spill_load_bytes;  ///< as the log tells
    bool operator==(const Build&) const = default;
};

/// One timed sample: `Work::renders` full renders of the case's work. Nanoseconds.
struct TimeSample {
    std::int64_t kernel_ns = 0;  ///< length of the union of the launches' [START, END] intervals
    std::int64_t sum_ns = 0;     ///< sum of the launches' END - START
    std::int64_t host_ns = 0;    ///< host clock around the same work
    std::int64_t queued_ns = 0;  ///< sum of SUBMIT - QUEUED
    std::int64_t submit_ns = 0;  ///< sum of START - SUBMIT
    std::int64_t probe_ns = 0;   ///< of the clock's probe right after it; 0 where there was none
    std::string cause;           ///< empty, or why it is flagged: "busy", ... (bench/measure/causes.h)
    bool operator==(const TimeSample&) const = default;
};

/// Statistics over the samples' headline time of one render, in nanoseconds.
struct Statistics {
    std::string timer;         ///< "event" or "host"
    std::string timer_reason;  ///< why not "event"
    int n = 0;                 ///< samples described
    int flagged = 0;           ///< samples with a cause; left out while they are under half of all
    double median_ns = 0, mad_ns = 0, mean_ns = 0, min_ns = 0, max_ns = 0, q1_ns = 0, q3_ns = 0;
    std::optional<double> ci_low_ns, ci_high_ns;  ///< exact 95 % interval of the median; absent for small n
    std::string stop_reason;  ///< "precision", "max_time", "max_samples", "max_total_time", "low_n"
    double msamples_per_s = 0, msegments_per_s = 0;
    std::optional<double>
        mrays_per_s;  ///< all that was traced, where that is more than paths' segments, or listed
    bool operator==(const Statistics&) const = default;
};

/// What the checks before (and of) the timing found. Absent numbers were not tested.
struct Validation {
    bool valid = false;
    std::string against;  ///< name of the reference, or what stood in for it
    std::string reason;   ///< why invalid, one line
    std::uint64_t samples = 0;
    std::optional<double> max_abs_z, z_limit;  ///< worst pixel block and the family's limit
    std::optional<double> mean_z;  ///< worst channel of the image mean, in combined standard errors
    double segments_per_sample = 0;
    std::optional<double> reference_segments_per_sample;
    std::vector<std::string> checks;  ///< names of the checks that ran: "finite", "counts", "blocks", ...
    bool operator==(const Validation&) const = default;
};

/// What the timed samples of a case took from the device's energy counter.
struct Energy {
    std::string source;            ///< "NVML", "RAPL package-0", or empty
    std::string reason;            ///< why there are no joules, or empty
    double window_s = 0;           ///< from the first timed sample's begin to the last one's end
    std::optional<double> joules;  ///< of one render, idle power included
    std::optional<double> samples_per_joule;
    std::optional<double> idle_w;  ///< before this worker's first case
    bool operator==(const Energy&) const = default;
};

/// Shares of what the device can do at most, as measured in the same run; 1 is all of it. Absent without that
/// peak or a time.
struct PeakShares {
    std::optional<double> fma, sqrt, division, global;
    std::string limit;  ///< the nearest one: "fma", "roots" (with divisions: one unit does both), "global"
    std::optional<double> limit_share;
    bool operator==(const PeakShares&) const = default;
};

/// What the kernel does, counted by an instrumented build of it on a part of the case's work: f32 arithmetic
/// on lanes that trace a path (a multiply-add is two), and bytes of global memory as the kernel asks for
/// them.
struct Counted {
    std::uint64_t segments = 0;  ///< counted on; 0: nothing was counted
    std::optional<double> flops_per_segment, roots_per_segment, divisions_per_segment, bytes_per_segment;
    std::optional<double> lanes_alive;  ///< mean share of a work-item's lanes, or a warp's, with a path
    std::string reason;                 ///< why a number is absent, or empty
    PeakShares of_peak;
    std::optional<double> nodes_per_ray{}, triangles_per_ray{};  ///< met in a tree, shadow rays included
    bool operator==(const Counted&) const = default;
};

/// The tree that a scene's triangles lie in (core/tree).
struct TreeRecord {
    std::string layout;  ///< "bvh2", "bvh2q" or "wide8"
    std::uint64_t triangles = 0;
    std::uint64_t references = 0;  ///< of leaves to triangles; splits of space make more of them
    std::uint64_t nodes = 0, leaves = 0;
    std::uint64_t bytes = 0;  ///< of device memory
    int depth = 0;            ///< inner nodes on the longest way to a leaf
    double sah_cost = 0;      ///< nodes and tests that a random ray is expected to take
    double build_ms = 0;      ///< host clock, on all cores, when this process built it
    bool operator==(const TreeRecord&) const = default;
};

/// Noise of an image relative to its reference, and what it is worth for the time it took.
struct Noise {
    double rel_mse = 0;
    double standard_error = 0;                    ///< of rel_mse, over pixels
    std::optional<double> efficiency, low, high;  ///< 1 / (rel_mse x seconds), and its 95 % interval
    bool operator==(const Noise&) const = default;
};

/// How much noise the timed image has (bench/validate), and so how efficient its kernel is. Pixels with the
/// largest errors, of paths that seldom find the light, can make up most of the mean: `best_99` leaves them
/// out.
struct Efficiency {
    std::optional<Noise> all, best_99;  ///< of all pixels, and of the best 99 %
    std::string variance_from;          ///< "film"; "reference" where that holds no squares; "passes"
    std::string reason;                 ///< why a number is absent, or empty
    bool operator==(const Efficiency&) const = default;
};

/// What a GPU's management library said of it after the last timed sample. Absent where it says nothing.
struct GpuState {
    std::optional<int> clock_mhz, memory_clock_mhz, temperature_c;
    std::optional<double> power_w;
    std::vector<std::string> throttle;  ///< why its clock is lower than it could be: "power cap", ...
    bool operator==(const GpuState&) const = default;
};

/// How several devices made one picture.
struct SharedWork {
    std::vector<std::string> devices{};  ///< their keys
    std::vector<double> device_ms{};     ///< of each, by its own clock, in the last sample
    double speedup = 0;     ///< over the fastest of them, by the speed at which it made its parts
    double efficiency = 0;  ///< share of the speed of all, each at its own parts
    bool operator==(const SharedWork&) const = default;
};

/// What became of one planned case. The one record type of protocol, journal and result file.
struct Record {
    Case params;
    Status status = Status::skipped;
    std::string reason;  ///< never empty unless ok: what a user can act on
    std::optional<Work> work;
    std::optional<Build> build;
    std::vector<TimeSample> samples;
    std::optional<Statistics> statistics;
    std::optional<Validation> validation;
    std::optional<Energy> energy;
    std::optional<Efficiency> efficiency;
    std::optional<Counted> counted;  ///< with --peaks
    std::optional<GpuState> gpu{};
    std::optional<TreeRecord> tree{};    ///< where the scene has meshes
    std::optional<SharedWork> shared{};  ///< where `params.devices` are several
    bool operator==(const Record&) const = default;
};

/// Time over SPP, t = overhead + spp x slope, of cases that differ in SPP alone.
struct SppFit {
    Case params;  ///< the case with the most SPP
    int points = 0;
    double overhead_ms = 0, ms_per_spp = 0;
    double r2 = 0;        ///< share of the variance that the line explains, points weighted by 1/t^2
    std::string warning;  ///< of a bad fit: what was seen and the likely cause; else empty
    bool operator==(const SppFit&) const = default;
};

/// What a device can do at most of one thing: a rate, or the time of a launch.
struct Peak {
    std::string name, unit;                  ///< "fma", "GFLOP/s"
    std::optional<double> value, low, high;  ///< median, and its exact 95 % interval
    int n = 0;
    std::string timer;   ///< "event" or "host"
    std::string reason;  ///< why there is no value, or why not to trust it
    bool operator==(const Peak&) const = default;
};

struct DevicePeaks {
    std::string device;
    std::string reason;  ///< why there are none
    std::vector<Peak> peaks;
    bool operator==(const DevicePeaks&) const = default;
};

/// A picture that the run left, and the case that it is of.
struct Picture {
    Case params;
    std::string file;  ///< name of a file beside the result file: "pocl-0.png"
    bool operator==(const Picture&) const = default;
};

/// One ICD that could not be used.
struct BrokenIcd {
    std::string icd, reason;
    bool operator==(const BrokenIcd&) const = default;
};

/// The facts of the host that a time depends on.
struct HostInfo {
    std::string hostname, os, kernel, cpu;
    int cores = 0;
    int cpus_allowed = 0;             ///< by affinity; 0: unknown
    std::optional<double> cpu_quota;  ///< CPUs whose time the smallest control group allows
    std::uint64_t memory_bytes = 0;
    double load_1min = 0;
    std::string node{};  ///< its name in a fleet, or empty
    bool operator==(const HostInfo&) const = default;
};

/// Which process writes a node's journal: one at a time may.
struct Lease {
    std::string boot_id;                ///< of the machine's last start
    int pid = 0;                        ///< of the process,
    std::uint64_t started_at_tick = 0;  ///< and when it began, since numbers come again
    std::string job;                    ///< of Slurm, or empty
    bool operator==(const Lease&) const = default;
};

/// A document of another schema within a file: an object there, or null when empty.
struct JsonText {
    std::string json;
    bool operator==(const JsonText&) const = default;
};

/// What was run.
struct RunInfo {
    std::vector<std::string> argv;
    std::string config, tool_version, git_sha, compiler, started_at;  ///< started_at: ISO 8601, UTC
    std::string folder;  ///< in which it began: relative paths are from there
    bool git_dirty = false;
    std::uint64_t seed = 0;
    bool interrupted = false;
    double wall_s = 0;                    ///< of all parts of a resumed run that came to their end
    JsonText settings;                    ///< what flags made of the config, as --dump-config
    std::vector<std::string> resumed_at;  ///< ISO 8601, UTC
    std::vector<std::string> scenes;      ///< of the plan: "furnace 9f86d081884c7d65", name and scene_hash
    std::vector<Case> tuned;       ///< what `ptbench tune` had found for devices and kernels of the plan
    double coordinator_cpu_s = 0;  ///< of the process that drives the workers: what measuring costs
    std::optional<Lease> lease{};  ///< of a node of a fleet
    std::vector<std::string> expected{};  ///< all nodes of the fleet that this one was told of
    std::string finished_at{};            ///< of such a node, once its last case is in its journal
    bool operator==(const RunInfo&) const = default;
};

/// A result file: the plan's facts and one record per planned case. Schema "ptbench.v1".
struct ResultFile {
    RunInfo run;
    HostInfo host;
    std::vector<HostInfo> hosts;  ///< of a fleet: every node's, of which `host` is the first
    std::vector<DeviceInfo> devices;
    std::vector<BrokenIcd> broken_icds;
    std::vector<Record> cases;
    std::vector<SppFit> fits;
    std::vector<Picture> pictures;  ///< the best of each device, or those at equal time
    std::vector<std::string> warnings;
    std::vector<DevicePeaks> peaks;  ///< with --peaks
    JsonText verdict;                ///< beside a baseline, as `compare --json` writes it
    bool operator==(const ResultFile&) const = default;
};

}  // namespace ptb
