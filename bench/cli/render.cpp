#include <algorithm>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/cli/check.h"
#include "bench/cli/commands.h"
#include "bench/cli/exit_code.h"
#include "bench/cli/interrupt.h"
#include "bench/cli/outputs.h"
#include "bench/cli/tell.h"
#include "bench/worker/render_job.h"
#include "core/image/image_io.h"
#include "core/input/printable.h"

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

DeviceInfo choose_device(const std::string& selector, const std::vector<DeviceInfo>& devices) {
    const auto chosen = select_devices({selector.empty() ? "all" : selector}, devices);
    if (chosen.size() == 1 || selector.empty()) return chosen.at(0);
    throw UsageError(fmt::format("-d: \"{}\" is {} devices; render takes one, e.g. -d {}", selector,
                                 chosen.size(), chosen[0].key));
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
    if (c.variant.pixel_filter == PixelFilter::stratified)
        throw UsageError(
            "--time: found beside pixel_filter stratified, whose grid is laid by --spp; allowed: "
            "jitter, centre");
}

Case case_of(const RenderFlags& flags) {
    Case c = default_case();
    for (const std::string& text : flags.axes) {
        const Axis axis = parse_axis(text);
        if (axis.points.size() != 1)
            throw UsageError(fmt::format(
                "-a: found \"{}\"; allowed: one value, since render makes one picture", printable(text)));
        for (std::size_t i = 0; i < axis.names.size(); ++i)
            set_case_value(c, axis.names[i], axis.points[0][i]);
    }
    for (const auto& [axis, value] : flags.axis_values) set_case_value(c, axis, value);
    check_case(c);
    check_names({c});
    check_time(flags, c);
    return c;
}

/// "written: x.png (123 SPP in 10.02 s)"
std::string outcome_text(const RenderRequest& request, const Rendered& rendered) {
    std::vector<std::string> remarks;
    if (request.time_s)
        remarks.push_back(fmt::format("{:.7g} SPP in {:.4g} s", rendered.spp, rendered.seconds));
    if (!rendered.whole) remarks.emplace_back("interrupted: as far as it got");
    if (remarks.empty()) return "written: " + request.output;
    return fmt::format("written: {} ({})", request.output, fmt::join(remarks, "; "));
}

void show_progress(double done) { put(stderr, fmt::format("\r{:3.0f} %", 100 * done)); }

}  // namespace

int render_command(const Options& options) {
    const RenderFlags& flags = options.render;
    check_output(flags.output);
    RenderRequest request{case_of(flags), flags.seed, options.common.kernel_dir, flags.output, flags.time_s};
    const DeviceList list = find_devices(options.common);
    if (!any_usable(list)) {
        put(stderr, no_device_text(list) + "\n");
        return exit_codes::no_device;
    }
    const DeviceInfo device = choose_device(flags.device, list.devices);
    const IcdFolder folder(icd_from_file(device.icd));
    see_only(folder);
    request.params.device = local_key(device.key);
    const auto& stop = watch_for_interruption();
    const bool live = !options.common.quiet && ::isatty(STDERR_FILENO) != 0;
    const Rendered rendered = render_to_file(
        request, live ? show_progress : [](double) {}, stop);
    if (live) put(stderr, "\r\033[K");
    tell(options.common, outcome_text(request, rendered));
    return rendered.whole ? exit_codes::done : exit_codes::interrupted;
}

}  // namespace ptb
