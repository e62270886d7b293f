#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/cli/options.h"
#include "bench/together/picture_ranges.h"

namespace ptb {

/// The devices that make one picture: those that are selected, where "all" leaves out CPUs beside others.
/// Throws UsageError.
std::vector<DeviceInfo> devices_to_share(const std::vector<std::string>& selectors,
                                         const std::vector<DeviceInfo>& devices);

/// What `--ranges` repeats. Throws UsageError for what is no such file, VersionMismatch for another ptbench,
/// kernel or scene than here.
PictureRanges picture_to_repeat(const RenderFlags& flags, const CommonFlags& common);

/// The devices that it was made by, in their order. Throws UsageError where one is missing, VersionMismatch
/// where another one has its key.
std::vector<DeviceInfo> devices_that_made(const PictureRanges& repeated,
                                          const std::vector<DeviceInfo>& devices);

/// Renders by all of these, and writes the picture, with who made what in it and in a file beside it. Returns
/// the exit code.
int render_together(const Options& options, const Case& params, const std::vector<DeviceInfo>& devices,
                    const std::optional<PictureRanges>& repeated);

/// Makes what this node gets of a picture that several make in the folder of `--fleet`; whoever sees all of
/// it there writes it. Returns the exit code.
int render_in_fleet(const Options& options, const Case& params, const std::vector<DeviceInfo>& devices);

}  // namespace ptb
