#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ptb::fuzz {

/// A reader of text that nobody vouches for, fed with any bytes. What it accepts must survive writing and
/// reading again, and everything that is done with it; what it refuses is refused in one line. Anything else
/// aborts.
struct Target {
    std::string name;  ///< also the folder of its corpus
    void (*feed)(std::string_view bytes);
};

const std::vector<Target>& targets();

}  // namespace ptb::fuzz
