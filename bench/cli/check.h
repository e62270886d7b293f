#pragma once

#include <string>
#include <vector>

#include "bench/cli/options.h"
#include "bench/plan/case.h"

namespace ptb {

/// Throws UsageError for a kernel or scene that does not exist, and for a scene file that cannot be used.
/// Says to stderr which large files it reads; the result says what of scenes is left out.
std::vector<std::string> check_names(const std::vector<Case>& cases, const CommonFlags& flags);

/// The same, and says to stderr what is left out.
void check_names_and_tell(const std::vector<Case>& cases, const CommonFlags& flags);

/// Throws UsageError where a case is of several devices at once.
void refuse_several_devices(const std::vector<Case>& cases, const std::string& command);

}  // namespace ptb
