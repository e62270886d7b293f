#include "bench/cli/render_together.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/outputs.h"
#include "bench/cli/rendering.h"
#include "bench/cli/tell.h"
#include "bench/fleet/nodes.h"
#include "bench/plan/data_dir.h"
#include "bench/plan/scene_file.h"
#include "bench/together/picture_crew.h"
#include "bench/together/picture_folder.h"
#include "core/file/path_lock.h"
#include "core/image/image_io.h"
#include "core/render/render.h"
#include "core/scene/content.h"

namespace ptb {
namespace {

constexpr const char* ranges_note = "ptbench.ranges";

std::string file_beside(const std::string& picture) { return picture + ".ranges.json"; }

bool is_cpu(const DeviceInfo& device) { return device.type == "CPU"; }

/// A CPU adds little beside GPUs, and takes the time of their drivers.
std::vector<DeviceInfo> without_unnamed_cpus(const std::vector<std::string>& words,
                                             std::vector<DeviceInfo> chosen,
                                             const std::vector<DeviceInfo>& devices) {
    if (std::all_of(chosen.begin(), chosen.end(), is_cpu)) return chosen;
    std::vector<std::string> named;
    std::copy_if(words.begin(), words.end(), std::back_inserter(named),
                 [](const std::string& word) { return word != "all"; });
    const auto by_name = named.empty() ? std::vector<DeviceInfo>() : select_devices(named, devices);
    std::erase_if(chosen, [&](const DeviceInfo& device) {
        const auto same = [&](const DeviceInfo& each) { return each.key == device.key; };
        return is_cpu(device) && std::none_of(by_name.begin(), by_name.end(), same);
    });
    return chosen;
}

std::string hash_of_scene(const Case& params) { return scene_hash(scene_file(params.scene, data_dir())); }

/// What its bits depend on, but for what comes of it.
PictureRanges ranges_for(const Case& params, std::uint64_t seed, const std::string& kernel_dir) {
    PictureRanges ranges;
    ranges.params = params;
    ranges.params.device.clear();
    ranges.seed = seed;
    ranges.scene_hash = hash_of_scene(params);
    ranges.facts = facts_here(kernel_dir).facts;
    std::erase_if(ranges.facts, [&](const auto& fact) {
        return fact.first.starts_with("kernel ") && fact.first != "kernel " + params.kernel;
    });
    return ranges;
}

SharedJob job_of(const Options& options, const Case& params, const std::vector<DeviceInfo>& devices,
                 const std::optional<PictureRanges>& repeated) {
    SharedJob job{params, devices, render_options(options.render, options.common)};
    if (!repeated) return job;
    job.measure.seed = repeated->seed;
    job.cut = repeated->cut;
    return job;
}

/// "pocl:0 61 %, pocl:1 39 %"
std::string shares_text(const SharedPicture& picture) {
    std::vector<std::string> shares;
    const auto all = static_cast<double>(picture.part_count);
    for (const DeviceParts& each : picture.by)
        shares.push_back(
            fmt::format("{} {:.1f} %", each.device, 100.0 * static_cast<double>(each.count()) / all));
    return fmt::format("{}", fmt::join(shares, ", "));
}

void tell_outcome(const Options& options, const SharedPicture& picture, const std::string& film_hash) {
    for (const std::string& remark : picture.remarks) tell(options.common, "warning: " + remark);
    const std::string& output = options.render.output;
    tell(options.common,
         fmt::format("written: {} {} ({}; {:.4g} s, {:.1f} % of the devices' speeds together; film {}{})",
                     output, file_beside(output), shares_text(picture), picture.wall_s,
                     100 * picture.efficiency(), film_hash,
                     picture.whole() ? "" : "; interrupted: as far as it got"));
}

/// With its ranges, where they are of all parts.
void write_picture(const std::string& file, const Image& image, const PictureRanges& ranges) {
    write_image(file, image, {{ranges_note, to_text(ranges)}});
    write_bytes(file_beside(file), to_text(ranges) + "\n");
}

SharedPicture rendered(const Options& options, const SharedJob& job, PictureRanges& ranges,
                       const std::optional<PictureRanges>& repeated) {
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    PictureCrew crew(job, process_channels(worker_launch(options.common), longest_silence, stopped), stopped);
    if (stopped()) throw Interrupted();
    ranges.cut = crew.cut();
    ranges.part_count = crew.part_count();
    if (repeated && repeated->part_count != ranges.part_count)
        throw UsageError(
            fmt::format("--ranges: found {} parts; allowed: {}", repeated->part_count, ranges.part_count));
    const ShareDone share(options.common.quiet);
    const auto show = [&](double done) { share.show(done); };
    SharedPicture picture =
        repeated ? crew.repeat(repeated->devices, show) : crew.make({{0, ranges.part_count}}, show);
    picture.check();
    return picture;
}

}  // namespace

std::vector<DeviceInfo> devices_to_share(const std::vector<std::string>& selectors,
                                         const std::vector<DeviceInfo>& devices) {
    const std::vector<std::string> words = device_words(selectors);
    if (words.empty()) return {select_devices({"all"}, devices).at(0)};
    return without_unnamed_cpus(words, select_devices(words, devices), devices);
}

PictureRanges picture_to_repeat(const RenderFlags& flags, const CommonFlags& common) {
    if (!flags.axes.empty() || !flags.axis_values.empty())
        throw UsageError("--ranges: found beside axes; allowed: alone, since it says what is rendered");
    PictureRanges repeated = parse_picture_ranges(read_text(flags.ranges), flags.ranges);
    const PictureRanges here = ranges_for(repeated.params, repeated.seed, common.kernel_dir);
    std::vector<std::string> other = differences(repeated.facts, "there", here.facts, "here");
    if (repeated.scene_hash != here.scene_hash)
        other.push_back(fmt::format("scene {}: {} there, {} here", repeated.params.scene, repeated.scene_hash,
                                    here.scene_hash));
    if (!other.empty())
        throw VersionMismatch(
            fmt::format("--ranges: {} is of something else: {}", flags.ranges, fmt::join(other, "; ")));
    return repeated;
}

std::vector<DeviceInfo> devices_that_made(const PictureRanges& repeated,
                                          const std::vector<DeviceInfo>& devices) {
    std::vector<DeviceInfo> chosen;
    for (const DeviceParts& each : repeated.devices) {
        chosen.push_back(select_devices({each.device}, devices).at(0));
        const DeviceInfo& here = chosen.back();
        if (here.name != each.name || here.driver_version != each.driver_version)
            throw VersionMismatch(fmt::format("--ranges: {} was {}, driver {}; is {}, driver {}", each.device,
                                              each.name, each.driver_version, here.name,
                                              here.driver_version));
    }
    return chosen;
}

int render_together(const Options& options, const Case& params, const std::vector<DeviceInfo>& devices,
                    const std::optional<PictureRanges>& repeated) {
    const RenderFlags& flags = options.render;
    if (flags.time_s)
        throw UsageError(fmt::format("--time: found beside {} devices; allowed: --spp", devices.size()));
    if (!options.common.launcher.empty())
        throw UsageError(fmt::format("--launcher: found beside {} devices; allowed: devices of this machine",
                                     devices.size()));
    check_writable("-o", file_beside(flags.output));
    PictureRanges ranges =
        ranges_for(params, repeated ? repeated->seed : flags.seed, options.common.kernel_dir);
    const SharedPicture picture =
        rendered(options, job_of(options, params, devices, repeated), ranges, repeated);
    if (!picture.sums) throw Interrupted();
    const Film film = film_of(*picture.sums);
    ranges.film_hash = film.hash;
    ranges.devices = picture.by;
    write_picture(flags.output, film.mean, ranges);
    tell_outcome(options, picture, film.hash);
    if (!picture.whole()) return exit_codes::interrupted;
    if (!repeated || repeated->film_hash == film.hash) return exit_codes::done;
    put(stderr,
        fmt::format("error: --ranges: film {} where {} has {}: a device computes otherwise, or the file was "
                    "changed\n",
                    film.hash, flags.ranges, repeated->film_hash));
    return exit_codes::wrong_image;
}

namespace {

std::vector<std::string> nodes_told(const RenderFlags& flags) {
    return flags.expect.empty() ? nodes_of_job() : nodes_in(flags.expect, "--expect");
}

/// A crew that cuts the picture as the folder says, which this node may have begun. `ranges` becomes the
/// folder's.
std::unique_ptr<PictureCrew> joined_crew(SharedJob job, const OpenChannel& open, const Stopped& stopped,
                                         PictureFolder& folder, std::size_t nodes, PictureRanges& ranges) {
    if (const auto begun = folder.begun()) job.cut = begun->cut;
    auto crew = std::make_unique<PictureCrew>(job, open, stopped);
    if (stopped()) throw Interrupted();
    ranges.cut = crew->cut();
    ranges.part_count = crew->part_count();
    std::vector<std::string> differing;
    ranges = folder.join(ranges, nodes, differing);
    if (!differing.empty())
        throw VersionMismatch(
            fmt::format("--fleet: another picture was begun there: {}", fmt::join(differing, "; ")));
    if (ranges.cut == crew->cut()) return crew;
    job.cut = ranges.cut;
    crew.reset();
    return std::make_unique<PictureCrew>(job, open, stopped);
}

double share_of(const std::vector<DeviceParts>& by, std::uint64_t part_count) {
    return 100.0 * static_cast<double>(parts_made(by)) / static_cast<double>(part_count);
}

/// Of all nodes, where it is whole; or says how far it is.
int write_fleet_picture(const Options& options, const PictureFolder& folder, PictureRanges ranges) {
    ranges.devices = folder.made();
    if (parts_made(ranges.devices) < ranges.part_count) {
        const std::set<std::string> owing = folder.owing();
        tell(options.common,
             fmt::format("{:.1f} % of the picture are in {}: {}", share_of(ranges.devices, ranges.part_count),
                         options.render.fleet,
                         owing.empty() ? "the rest is nobody's; this command again makes it"
                                       : fmt::format("the rest is of {}; who ends last writes it",
                                                     fmt::join(owing, ", "))));
        return exit_codes::done;
    }
    if (const std::string fault = fault_of(ranges); !fault.empty())
        throw std::runtime_error(fmt::format("{}/films: {}", options.render.fleet, fault));
    const Film film = film_of(folder.merged());
    ranges.film_hash = film.hash;
    const std::string& output = options.render.output;
    write_picture(output, film.mean, ranges);
    tell(options.common, fmt::format("written: {} {} (film {})", output, file_beside(output), film.hash));
    return exit_codes::done;
}

}  // namespace

int render_in_fleet(const Options& options, const Case& params, const std::vector<DeviceInfo>& devices) {
    const RenderFlags& flags = options.render;
    if (!options.common.launcher.empty())
        throw UsageError("--launcher: found beside --fleet; allowed: devices of this machine");
    check_writable("-o", file_beside(flags.output));
    const std::string node = this_node();
    PictureFolder folder(flags.fleet);
    PathLock lock;
    if (!lock.take_file(folder.lock(node)))
        throw UsageError(fmt::format("--fleet: another process of {} makes its part of the picture", node));
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    PictureRanges ranges = ranges_for(params, flags.seed, options.common.kernel_dir);
    const auto crew = joined_crew(job_of(options, params, devices, std::nullopt),
                                  process_channels(worker_launch(options.common), longest_silence, stopped),
                                  stopped, folder, nodes_told(flags).size(), ranges);
    folder.give_up_claims(node);
    const ShareDone share(options.common.quiet);
    std::exception_ptr folder_failed;  // what was made by then is left all the same
    const auto claim = [&]() -> std::optional<PartRange> {
        try {
            return folder.claim(node);
        } catch (...) {
            folder_failed = std::current_exception();
            return std::nullopt;
        }
    };
    const SharedPicture picture = crew->make(
        {}, [&](double done) { share.show(done); }, claim);
    for (const std::string& remark : picture.remarks) tell(options.common, "warning: " + remark);
    if (picture.sums) folder.leave(node, *picture.sums, picture.by);
    const bool interrupted = stopped();
    if (interrupted || folder_failed || !picture.failure.empty()) folder.give_up_claims(node);
    if (folder_failed) std::rethrow_exception(folder_failed);
    picture.check();
    tell(options.common,
         fmt::format(
             "{}: made {:.1f} % of the picture{}", node, share_of(picture.by, ranges.part_count),
             interrupted ? "; interrupted: what is made is kept, and what it claimed is open again" : ""));
    if (interrupted) return exit_codes::interrupted;
    return write_fleet_picture(options, folder, ranges);
}

}  // namespace ptb
