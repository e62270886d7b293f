#pragma once

#include <string>

#include "bench/record/record.h"

namespace ptb {

/// A result so small that its page can carry it: a line of JSON, with the run's "name", the result file's
/// text without samples ("text") and how to read those, column by column, a case after another ("samples");
/// behind it the columns' bits. All deflated, in base 91. page/data.js makes the file's text of it again,
/// byte by byte.
std::string packed(const ResultFile& result, const std::string& name);

/// Any text, likewise: {"text": ..., "samples": []}.
std::string packed_text(const std::string& text);

}  // namespace ptb
