#pragma once

#include <string>

#include "bench/record/record.h"

namespace ptb {

/// A result so small that its page can carry it: JSON of the result file's text without samples ("text") and
/// of the samples column by column ("samples", one a case), under the run's "name", deflated, in base64.
/// page/data.js makes the file's text of it again, byte by byte.
std::string packed(const ResultFile& result, const std::string& name);

/// Any text, likewise: {"text": ..., "samples": []}.
std::string packed_text(const std::string& text);

}  // namespace ptb
