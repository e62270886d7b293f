#pragma once

#include <string>
#include <vector>

#include "bench/compare/session.h"

namespace ptb {

/// A fact that two sessions know of a case, each in its own way.
struct Difference {
    std::string field, text;  ///< "driver", "driver: \"3.1\" and \"4.0\""
    bool may_differ = false;
};
std::vector<Difference> differences(const SessionCase& one, const SessionCase& other);

}  // namespace ptb
