#pragma once

#include <string>
#include <vector>

#include "bench/compare/session.h"

namespace ptb {

/// One case over the sessions of both sides: those that have a time.
struct Matched {
    const SessionCase* like = nullptr;
    std::vector<const SessionCase*> base, now;
    std::string why_not = "not in the file";  ///< the new side has no time
};

/// Every case of the base once, then those that only the new side has. A scene is its text, wherever its file
/// lies; a device is its UUID, else its number and name, else its name, where that is the only one; `cross`
/// takes the only device of one side for the other's. The sessions must outlive what is returned.
std::vector<Matched> match(const std::vector<Session>& base, const std::vector<Session>& now, bool cross);

}  // namespace ptb
