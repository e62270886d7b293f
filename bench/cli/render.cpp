#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "bench/cli/check.h"
#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/outputs.h"
#include "bench/cli/render_together.h"
#include "bench/cli/rendering.h"
#include "bench/cli/tell.h"
#include "bench/report/heat_map.h"
#include "bench/report/words.h"
#include "bench/worker/device_worker.h"
#include "core/image/image_io.h"
#include "core/input/printable.h"
#include "core/integrator/registry.h"

namespace ptb {
namespace {

void check_output(const std::string& output) {
    if (output.empty()) throw UsageError("render: -o FILE is missing (.exr, .pfm, .png or .ppm)");
    if (!is_image_file(output)) {
        throw UsageError(fmt::format(
            "-o: found \"{}\"; allowed: a file that ends in .exr, .pfm, .png or .ppm", printable(output)));
    }
    check_writable("-o", output);
}

Aov aov_of(const RenderFlags& flags) {
    const auto found = std::find(aov_names.begin(), aov_names.end(), flags.aov);
    return found == aov_names.end() ? Aov::radiance : static_cast<Aov>(found - aov_names.begin());
}

void set_only_point(Case& c, const Axis& axis, const std::string& flag, const std::string& text) {
    if (axis.points.size() != 1)
        throw UsageError(fmt::format("{}: found \"{}\"; allowed: one value, since render makes one picture",
                                     flag, printable(text)));
    for (std::size_t i = 0; i < axis.names.size(); ++i) set_case_value(c, axis.names[i], axis.points[0][i]);
}

bool names_spp(const RenderFlags& flags) {
    const auto of_spp = [](const std::string& text) {
        const auto names = parse_axis(text).names;
        return std::find(names.begin(), names.end(), "spp") != names.end();
    };
    return flags.axis_values.contains("spp") || std::any_of(flags.axes.begin(), flags.axes.end(), of_spp);
}

/// How many samples a pixel gets must not be asked for twice, nor be known before.
void check_time(const RenderFlags& flags, const Case& c) {
    if (!flags.time_s) return;
    if (names_spp(flags))
        throw UsageError(
            "--time: found beside --spp; allowed: one of them, since the time decides the samples");
    if (integrator(c.kernel).lists_rays)
        throw UsageError(fmt::format(
            "--time: found beside kernel {}, whose list has its length; allowed: --spp", c.kernel));
    if (c.variant.pixel_filter == PixelFilter::stratified)
        throw UsageError(
            "--time: found beside pixel_filter stratified, whose grid is laid by --spp; allowed: "
            "jitter, centre");
}

Case case_of(const RenderFlags& flags, const CommonFlags& common) {
    Case c = default_case();
    for (const std::string& text : flags.axes) set_only_point(c, parse_axis(text), "-a", text);
    for (const auto& [axis, text] : flags.axis_values)
        set_only_point(c, axis_of_values(axis, text), axis, text);
    check_case(c);
    if (const std::string axis = of_several_devices(c); !axis.empty())
        throw UsageError(
            fmt::format("{}: render makes one picture; allowed: -d, which names its devices", axis));
    check_names_and_tell({c}, common);
    check_time(flags, c);
    return c;
}

/// The answer to a request to render; throws why there is none.
Reply rendered(DeviceWorker& worker, const Case& c, const RenderFlags& flags, bool quiet) {
    if (!worker.ready()) {
        if (worker.given_up().empty()) throw Interrupted();
        throw std::runtime_error(worker.given_up());
    }
    Request request;
    request.kind = Request::Kind::render;
    request.params = c;
    request.time_s = flags.time_s;
    request.aov = aov_of(flags);
    const ShareDone share(quiet);
    Reply reply = worker.request(request, [&](const Response& progress) {
        if (progress.stage == "render") share.show(progress.done);
    });
    if (reply.end != Reply::End::answered) throw std::runtime_error(reply.reason);
    if (reply.response.kind == Response::Kind::refused) throw UsageError(reply.response.reason);
    if (reply.response.kind != Response::Kind::rendered) throw std::runtime_error(reply.response.reason);
    if (!reply.picture) throw std::runtime_error("the picture did not arrive whole");
    return reply;
}

Image by_size(Image picture) {
    for (float& value : picture.rgb) value = std::abs(value);
    return picture;
}

/// Writes the picture, costs as a heat map and differences by their size where a file holds colours; returns
/// what is to be said of it.
std::vector<std::string> write_picture(const RenderFlags& flags, const Image& picture) {
    const Aov aov = aov_of(flags);
    if (aov != Aov::cost) {
        const bool differs = (aov == Aov::dx || aov == Aov::dy) && !keeps_floats(flags.output);
        write_image(flags.output, differs ? by_size(picture) : picture);
        return {};
    }
    const HeatMap map = heat_map(picture);
    write_image(flags.output, keeps_floats(flags.output) ? picture : map.image);
    return {fmt::format("nodes of a sample: {} to {}, mean {}; white: {:.0f}", number_text(map.least),
                        number_text(map.most), number_text(map.mean), map.white)};
}

/// "written: x.png (123 SPP in 10.02 s)"
std::string outcome_text(const std::string& output, const Response& rendered,
                         std::vector<std::string> remarks) {
    remarks.insert(remarks.begin(), fmt::format("{:.7g} SPP in {:.4g} s", rendered.spp, rendered.seconds));
    if (!rendered.whole) remarks.emplace_back("interrupted: as far as it got");
    return fmt::format("written: {} ({})", output, fmt::join(remarks, "; "));
}

int render_alone(const Options& options, Case c, const DeviceInfo& device) {
    const RenderFlags& flags = options.render;
    c.device = device.key;
    const Stopped stopped = [&stop = watch_for_interruption()] { return stop.load(); };
    DeviceWorker worker(device, process_channels(worker_launch(options.common), longest_silence, stopped),
                        render_options(flags, options.common));
    const Reply reply = rendered(worker, c, flags, options.common.quiet);
    if (options.common.verbose && !reply.printed.empty())
        tell(options.common, "printed by the driver:\n" + reply.printed);
    const std::vector<std::string> remarks = write_picture(flags, *reply.picture);
    tell(options.common, outcome_text(flags.output, reply.response, remarks));
    return reply.response.whole ? exit_codes::done : exit_codes::interrupted;
}

}  // namespace

MeasureOptions render_options(const RenderFlags& flags, const CommonFlags& common) {
    MeasureOptions options;
    options.seed = flags.seed;
    options.kernel_dir = common.kernel_dir;
    return options;
}

void ShareDone::show(double done) const {
    if (live_) put(stderr, fmt::format("\r{:3.0f} %", 100 * done));
}

int render_command(const Options& options) {
    const RenderFlags& flags = options.render;
    check_output(flags.output);
    std::optional<PictureRanges> repeated;
    if (!flags.ranges.empty()) repeated = picture_to_repeat(flags, options.common);
    const Case c = repeated ? repeated->params : case_of(flags, options.common);
    const DeviceList list = find_devices(options.common);
    if (!any_usable(list)) {
        put(stderr, no_device_text(list) + "\n");
        return exit_codes::no_device;
    }
    const auto devices =
        repeated ? devices_that_made(*repeated, list.devices) : devices_to_share(flags.devices, list.devices);
    const bool together = repeated || devices.size() > 1;
    if (aov_of(flags) != Aov::radiance && (together || !flags.fleet.empty()))
        throw UsageError(fmt::format(
            "--aov: found \"{}\"; allowed: radiance, where several devices make one picture", flags.aov));
    if (!flags.fleet.empty()) return render_in_fleet(options, c, devices);
    return together ? render_together(options, c, devices, repeated) : render_alone(options, c, devices[0]);
}

}  // namespace ptb
