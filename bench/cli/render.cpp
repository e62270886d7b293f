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

void set_only_point(Case& c, const Axis& axis, const std::string& flag, const std::string& text) {
    if (axis.points.size() != 1)
        throw UsageError(fmt::format("{}: found \"{}\"; allowed: one value, since render makes one picture",
                                     flag, printable(text)));
    for (std::size_t i = 0; i < axis.names.size(); ++i) set_case_value(c, axis.names[i], axis.points[0][i]);
}

Case case_of(const RenderFlags& flags) {
    Case c = default_case();
    for (const std::string& text : flags.axes) set_only_point(c, parse_axis(text), "-a", text);
    for (const auto& [axis, text] : flags.axis_values)
        set_only_point(c, axis_of_values(axis, text), axis, text);
    check_case(c);
    check_names({c});
    return c;
}

void show_progress(double done) { put(stderr, fmt::format("\r{:3.0f} %", 100 * done)); }

}  // namespace

int render_command(const Options& options) {
    const RenderFlags& flags = options.render;
    check_output(flags.output);
    RenderRequest request{case_of(flags), flags.seed, options.common.kernel_dir, flags.output};
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
    const bool whole = render_to_file(
        request, live ? show_progress : [](double) {}, stop);
    if (live) put(stderr, "\r\033[K");
    tell(options.common, "written: " + flags.output + (whole ? "" : " (interrupted: as far as it got)"));
    return whole ? exit_codes::done : exit_codes::interrupted;
}

}  // namespace ptb
