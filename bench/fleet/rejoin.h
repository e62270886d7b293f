#pragma once

#include <vector>

#include "bench/record/record.h"

namespace ptb {

/// An earlier part of a node's run, as its devices are called now: one that is known by its UUID is found
/// wherever it is, another by its key and name.
struct Rejoined {
    ResultFile earlier;            ///< without those that left
    std::vector<DeviceInfo> gone;  ///< excluded, with why
    std::vector<Record> of_gone;
    std::vector<DeviceInfo> devices;  ///< to be measured: those that were, and those that are chosen now
};

/// @param there   all devices of the node, as they are now
/// @param chosen  keys of those that are asked for now
Rejoined rejoined(const ResultFile& earlier, const std::vector<DeviceInfo>& there,
                  const std::vector<DeviceInfo>& chosen);

}  // namespace ptb
