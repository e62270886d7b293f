#pragma once

#include <string>

#include "bench/record/record.h"
#include "bench/report/published.h"

namespace ptb {

/// The report for a terminal. What drivers and files say is made printable.
std::string table(const ResultFile& result, const PublishedTable& published, const TextStyle& style = {});

}  // namespace ptb
