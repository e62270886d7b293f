#pragma once

#include <string>

#include "bench/record/record.h"
#include "bench/report/published.h"

namespace ptb {

/// The same sections as GitHub-flavoured Markdown, for a summary of a CI step. Text is escaped.
std::string markdown(const ResultFile& result, const PublishedTable& published);

}  // namespace ptb
