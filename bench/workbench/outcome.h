#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "bench/record/record.h"

namespace ptb {

/// Asked work that this device or kernel refuses; `what()` names the limit.
struct Unsupported : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Ends a record. One without a valid time keeps no part of any.
void conclude(Record& record, Status status, const std::string& reason);

/// Ends a record by what became of its image; an unstable one stays that.
void conclude_by_image(Record& record);

/// Makes an attempt at a case; what it throws becomes the status and the reason of its record.
void conclude_attempt(Record& record, const std::function<void()>& attempt);

}  // namespace ptb
