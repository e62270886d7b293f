#pragma once

#include <string>

#include "bench/record/record.h"

namespace ptb {

/// Of a process, or of this one, in this one's job.
Lease lease_of(int pid);
Lease this_lease();

/// Whether its process runs: on this machine since its last start, and the same one. That of another machine
/// of the same name counts as ended.
bool is_living(const Lease& lease);

/// "process 4711 of job 42"
std::string text_of(const Lease& lease);

}  // namespace ptb
