#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "bench/cli/options.h"
#include "bench/report/grid.h"
#include "bench/worker/probe.h"

namespace ptb {

/// Writes text. Never throws: a reader who has left must not cost a run its results; `main` asks stdout at
/// the end whether all was taken.
void put(std::FILE* out, const std::string& text);

/// Says to stderr what only matters to a person who watches; nothing under -q, and nothing for an empty line.
void tell(const CommonFlags& flags, const std::string& line);

/// Says what a launcher last said while it has not started a worker.
void tell_waiting(const CommonFlags& flags, const std::string& words);

/// Whether to colour what goes to `out`: as --color says, else only on a terminal and without NO_COLOR.
bool use_colour(const CommonFlags& flags, std::FILE* out);

/// Width and colours of what goes to `out`; no limit unless it is a terminal.
TextStyle text_style(const CommonFlags& flags, std::FILE* out);

/// Under -v: devices and drivers that are not used, and why.
void tell_what_is_left_out(const CommonFlags& flags, const DeviceList& list);

/// Under -v: what compilers said, once for each kernel and device.
void tell_build_logs(const CommonFlags& flags, const std::vector<Record>& records);

}  // namespace ptb
