#pragma once

#include "bench/plan/config.h"
#include "bench/record/fields.h"
#include "bench/record/record.h"

namespace ptb {

// The mapping of each struct of record.h: `encode(x)` and `decode(json, where, x)`, and with the names that
// nlohmann/json looks for, `Json json = x` and `json.get<X>()`. Optional values that are absent are null.

template <>
inline constexpr auto fields<Work> =
    std::make_tuple(field("samples", &Work::samples), field("segments", &Work::segments),
                    field("shadow_rays", &Work::shadow_rays), field("light_segments", &Work::light_segments),
                    field("full_length_paths", &Work::full_length_paths), field("lanes", &Work::lanes),
                    field("renders", &Work::renders), field("passes", &Work::passes),
                    field("longest_launch_ns", &Work::longest_launch_ns),
                    field("device_bytes", &Work::device_bytes), field("overlap", &Work::overlap),
                    field("film_hash", &Work::film_hash), field("listed_rays", &Work::listed_rays));

template <>
inline constexpr auto fields<Build> = std::make_tuple(
    field("options", &Build::options), field("kernel_hash", &Build::kernel_hash),
    field("overridden", &Build::overridden), field("build_ms", &Build::build_ms),
    field("upload_ms", &Build::upload_ms), field("readback_ms", &Build::readback_ms),
    field("first_launch_ns", &Build::first_launch_ns), field("max_work_group", &Build::max_work_group),
    field("preferred_multiple", &Build::preferred_multiple), field("local_bytes", &Build::local_bytes),
    field("private_bytes", &Build::private_bytes), field("log", &Build::log),
    field("binary_bytes", &Build::binary_bytes), field("registers", &Build::registers),
    field("spill_store_bytes", &Build::spill_store_bytes),
    field("spill_load_bytes", &Build::spill_load_bytes));

template <>
inline constexpr auto fields<TimeSample> = std::make_tuple(required("kernel_ns", &TimeSample::kernel_ns),
                                                           field("sum_ns", &TimeSample::sum_ns),
                                                           required("host_ns", &TimeSample::host_ns),
                                                           field("queued_ns", &TimeSample::queued_ns),
                                                           field("submit_ns", &TimeSample::submit_ns),
                                                           field("probe_ns", &TimeSample::probe_ns),
                                                           field("cause", &TimeSample::cause));

template <>
inline constexpr auto fields<Statistics> = std::make_tuple(
    field("timer", &Statistics::timer), field("timer_reason", &Statistics::timer_reason),
    required("n", &Statistics::n), field("flagged", &Statistics::flagged),
    required("median_ns", &Statistics::median_ns), field("mad_ns", &Statistics::mad_ns),
    field("mean_ns", &Statistics::mean_ns), field("min_ns", &Statistics::min_ns),
    field("max_ns", &Statistics::max_ns), field("q1_ns", &Statistics::q1_ns),
    field("q3_ns", &Statistics::q3_ns), field("ci_low_ns", &Statistics::ci_low_ns),
    field("ci_high_ns", &Statistics::ci_high_ns), field("stop_reason", &Statistics::stop_reason),
    field("msamples_per_s", &Statistics::msamples_per_s),
    field("msegments_per_s", &Statistics::msegments_per_s), field("mrays_per_s", &Statistics::mrays_per_s));

template <>
inline constexpr auto fields<Validation> = std::make_tuple(
    required("valid", &Validation::valid), field("against", &Validation::against),
    field("reason", &Validation::reason), field("samples", &Validation::samples),
    field("max_abs_z", &Validation::max_abs_z), field("z_limit", &Validation::z_limit),
    field("mean_z", &Validation::mean_z), field("segments_per_sample", &Validation::segments_per_sample),
    field("reference_segments_per_sample", &Validation::reference_segments_per_sample),
    field("checks", &Validation::checks));

template <>
inline constexpr auto fields<Energy> = std::make_tuple(field("source", &Energy::source),
                                                       field("reason", &Energy::reason),
                                                       field("window_s", &Energy::window_s),
                                                       field("joules", &Energy::joules),
                                                       field("samples_per_joule", &Energy::samples_per_joule),
                                                       field("idle_w", &Energy::idle_w));

template <>
inline constexpr auto fields<Peak> = std::make_tuple(required("name", &Peak::name),
                                                     field("unit", &Peak::unit), field("value", &Peak::value),
                                                     field("low", &Peak::low), field("high", &Peak::high),
                                                     field("n", &Peak::n), field("timer", &Peak::timer),
                                                     field("reason", &Peak::reason));

template <>
inline constexpr auto fields<DevicePeaks> = std::make_tuple(required("device", &DevicePeaks::device),
                                                            field("reason", &DevicePeaks::reason),
                                                            field("peaks", &DevicePeaks::peaks));

template <>
inline constexpr auto fields<PeakShares> = std::make_tuple(field("fma", &PeakShares::fma),
                                                           field("sqrt", &PeakShares::sqrt),
                                                           field("division", &PeakShares::division),
                                                           field("global", &PeakShares::global),
                                                           field("limit", &PeakShares::limit),
                                                           field("limit_share", &PeakShares::limit_share));

template <>
inline constexpr auto fields<Counted> = std::make_tuple(
    field("segments", &Counted::segments), field("flops_per_segment", &Counted::flops_per_segment),
    field("roots_per_segment", &Counted::roots_per_segment),
    field("divisions_per_segment", &Counted::divisions_per_segment),
    field("bytes_per_segment", &Counted::bytes_per_segment), field("lanes_alive", &Counted::lanes_alive),
    field("reason", &Counted::reason), field("of_peak", &Counted::of_peak),
    field("nodes_per_ray", &Counted::nodes_per_ray), field("triangles_per_ray", &Counted::triangles_per_ray));

template <>
inline constexpr auto fields<TreeRecord> =
    std::make_tuple(required("layout", &TreeRecord::layout), required("triangles", &TreeRecord::triangles),
                    field("references", &TreeRecord::references), field("nodes", &TreeRecord::nodes),
                    field("leaves", &TreeRecord::leaves), field("bytes", &TreeRecord::bytes),
                    field("depth", &TreeRecord::depth), field("sah_cost", &TreeRecord::sah_cost),
                    field("build_ms", &TreeRecord::build_ms));

template <>
inline constexpr auto fields<Noise> = std::make_tuple(required("rel_mse", &Noise::rel_mse),
                                                      required("standard_error", &Noise::standard_error),
                                                      field("efficiency", &Noise::efficiency),
                                                      field("low", &Noise::low), field("high", &Noise::high));

template <>
inline constexpr auto fields<Efficiency> = std::make_tuple(field("all", &Efficiency::all),
                                                           field("best_99", &Efficiency::best_99),
                                                           field("variance_from", &Efficiency::variance_from),
                                                           field("reason", &Efficiency::reason));

template <>
inline constexpr auto fields<GpuState> = std::make_tuple(
    field("clock_mhz", &GpuState::clock_mhz), field("memory_clock_mhz", &GpuState::memory_clock_mhz),
    field("temperature_c", &GpuState::temperature_c), field("power_w", &GpuState::power_w),
    field("throttle", &GpuState::throttle));

template <>
inline constexpr auto fields<SharedWork> = std::make_tuple(required("devices", &SharedWork::devices),
                                                           required("device_ms", &SharedWork::device_ms),
                                                           required("speedup", &SharedWork::speedup),
                                                           required("efficiency", &SharedWork::efficiency));

template <>
inline constexpr auto fields<Record> = std::make_tuple(
    required("params", &Record::params), required("status", &Record::status),
    field("reason", &Record::reason), field("work", &Record::work), field("build", &Record::build),
    field("samples", &Record::samples), field("statistics", &Record::statistics),
    field("validation", &Record::validation), field("energy", &Record::energy),
    field("efficiency", &Record::efficiency), field("counted", &Record::counted), field("gpu", &Record::gpu),
    field("tree", &Record::tree), field("shared", &Record::shared));

template <>
inline constexpr auto fields<DeviceInfo> = std::make_tuple(
    required("key", &DeviceInfo::key), field("platform_index", &DeviceInfo::platform_index),
    field("device_index", &DeviceInfo::device_index), field("icd", &DeviceInfo::icd),
    field("platform", &DeviceInfo::platform), field("platform_version", &DeviceInfo::platform_version),
    required("name", &DeviceInfo::name), required("vendor", &DeviceInfo::vendor),
    required("type", &DeviceInfo::type), field("version", &DeviceInfo::version),
    field("driver_version", &DeviceInfo::driver_version), field("c_version", &DeviceInfo::c_version),
    field("uuid", &DeviceInfo::uuid), field("compute_units", &DeviceInfo::compute_units),
    field("clock_mhz", &DeviceInfo::clock_mhz), field("native_float_width", &DeviceInfo::native_float_width),
    field("default_lanes", &DeviceInfo::default_lanes), field("global_bytes", &DeviceInfo::global_bytes),
    field("max_alloc_bytes", &DeviceInfo::max_alloc_bytes),
    field("constant_bytes", &DeviceInfo::constant_bytes), field("local_bytes", &DeviceInfo::local_bytes),
    field("max_work_group", &DeviceInfo::max_work_group),
    field("max_work_item_sizes", &DeviceInfo::max_work_item_sizes),
    field("timer_resolution_ns", &DeviceInfo::timer_resolution_ns), field("images", &DeviceInfo::images),
    field("profiling", &DeviceInfo::profiling), field("pci", &DeviceInfo::pci),
    field("node", &DeviceInfo::node), field("serial", &DeviceInfo::serial),
    field("vbios", &DeviceInfo::vbios), field("ecc", &DeviceInfo::ecc),
    field("max_clock_mhz", &DeviceInfo::max_clock_mhz),
    field("max_memory_clock_mhz", &DeviceInfo::max_memory_clock_mhz),
    field("power_limit_w", &DeviceInfo::power_limit_w), field("excluded", &DeviceInfo::excluded));

template <>
inline constexpr auto fields<SppFit> = std::make_tuple(required("params", &SppFit::params),
                                                       required("points", &SppFit::points),
                                                       field("overhead_ms", &SppFit::overhead_ms),
                                                       field("ms_per_spp", &SppFit::ms_per_spp),
                                                       field("r2", &SppFit::r2),
                                                       field("warning", &SppFit::warning));

template <>
inline constexpr auto fields<Picture> = std::make_tuple(required("params", &Picture::params),
                                                        required("file", &Picture::file));

template <>
inline constexpr auto fields<BrokenIcd> = std::make_tuple(required("icd", &BrokenIcd::icd),
                                                          required("reason", &BrokenIcd::reason));

template <>
inline constexpr auto fields<HostInfo> =
    std::make_tuple(field("hostname", &HostInfo::hostname), field("os", &HostInfo::os),
                    field("kernel", &HostInfo::kernel), field("cpu", &HostInfo::cpu),
                    field("cores", &HostInfo::cores), field("cpus_allowed", &HostInfo::cpus_allowed),
                    field("cpu_quota", &HostInfo::cpu_quota), field("memory_bytes", &HostInfo::memory_bytes),
                    field("load_1min", &HostInfo::load_1min), field("node", &HostInfo::node));

template <>
inline constexpr auto fields<Lease> = std::make_tuple(required("boot_id", &Lease::boot_id),
                                                      required("pid", &Lease::pid),
                                                      field("started_at_tick", &Lease::started_at_tick),
                                                      field("job", &Lease::job));

template <>
inline constexpr auto fields<RunInfo> = std::make_tuple(
    field("argv", &RunInfo::argv), field("config", &RunInfo::config), field("folder", &RunInfo::folder),
    field("tool_version", &RunInfo::tool_version), field("git_sha", &RunInfo::git_sha),
    field("git_dirty", &RunInfo::git_dirty), field("compiler", &RunInfo::compiler),
    field("started_at", &RunInfo::started_at), field("seed", &RunInfo::seed),
    field("interrupted", &RunInfo::interrupted), field("wall_s", &RunInfo::wall_s),
    field("settings", &RunInfo::settings), field("resumed_at", &RunInfo::resumed_at),
    field("scenes", &RunInfo::scenes), field("tuned", &RunInfo::tuned),
    field("coordinator_cpu_s", &RunInfo::coordinator_cpu_s), field("lease", &RunInfo::lease),
    field("expected", &RunInfo::expected), field("finished_at", &RunInfo::finished_at));

template <>
inline constexpr auto fields<ResultFile> =
    std::make_tuple(required("run", &ResultFile::run), required("host", &ResultFile::host),
                    field("hosts", &ResultFile::hosts), required("devices", &ResultFile::devices),
                    field("broken_icds", &ResultFile::broken_icds), field("warnings", &ResultFile::warnings),
                    required("cases", &ResultFile::cases), field("fits", &ResultFile::fits),
                    field("peaks", &ResultFile::peaks), field("pictures", &ResultFile::pictures),
                    field("verdict", &ResultFile::verdict));

template <>
inline constexpr auto fields<MeasureOptions> = std::make_tuple(
    field("seed", &MeasureOptions::seed), field("warmup", &MeasureOptions::warmup),
    field("min_samples", &MeasureOptions::min_samples), field("max_samples", &MeasureOptions::max_samples),
    field("max_time", &MeasureOptions::max_time_s), field("timer", &MeasureOptions::timer),
    field("skip_time", &MeasureOptions::skip_time), field("kernel_dir", &MeasureOptions::kernel_dir),
    field("count", &MeasureOptions::count));

/// A case is written in the words of the axes: "size": "128x128", "work_group": "implicit", "lanes": "auto".
Json encode(const Case& c);
void decode(const Json& json, const Where& where, Case& c);
Json encode(Size size);
void decode(const Json& json, const Where& where, Size& size);
Json encode(const JsonText& text);
void decode(const Json& json, const Where& where, JsonText& text);
Json encode(Status status);
void decode(const Json& json, const Where& where, Status& status);

// The large ones are compiled once, in json.cpp.
extern template Json encode(const DeviceInfo& value);
extern template Json encode(const DevicePeaks& value);
extern template Json encode(const Record& value);
extern template Json encode(const ResultFile& value);
extern template Json encode(const RunInfo& value);
extern template void decode(const Json& json, const Where& where, DeviceInfo& value);
extern template void decode(const Json& json, const Where& where, DevicePeaks& value);
extern template void decode(const Json& json, const Where& where, Record& value);
extern template void decode(const Json& json, const Where& where, ResultFile& value);
extern template void decode(const Json& json, const Where& where, RunInfo& value);

/// The result file's sections behind its "schema".
Json result_to_json(const ResultFile& result);
/// Throws UsageError on anything but a result file of a version that is known.
ResultFile result_from_json(const Json& json, const std::string& origin);

template <class Struct>
concept Mapped = HasFields<Struct> || std::same_as<Struct, Case>;

template <Mapped Struct>
void to_json(Json& json, const Struct& value) {
    json = encode(value);
}
template <Mapped Struct>
void from_json(const Json& json, Struct& value) {
    const std::string origin = "JSON";
    decode(json, Where(origin), value);
}

}  // namespace ptb
