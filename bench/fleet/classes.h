#pragma once

#include <string>
#include <vector>

#include "bench/fleet/fleet.h"

namespace ptb {

/// Devices that should be equally fast: of one name, driver, platform version, units and memory. What
/// ptbench, kernels and launches are is equal in a fleet by its plan.
struct DeviceClass {
    std::vector<std::size_t> cards;  ///< of Fleet::cards
};

/// The largest first.
std::vector<DeviceClass> classes_of(const Fleet& fleet);

/// A fact in which some cards of a class differ from most of them.
struct Drift {
    std::string fact, most;  ///< "ECC", "on"
    std::string value;       ///< of those that differ
    std::vector<std::size_t> cards;
};
std::vector<Drift> drift_in(const Fleet& fleet, const DeviceClass& of);

/// Cards whose images are not those of their equals.
struct WrongBits {
    std::size_t card = 0, work = 0;
    bool in_doubt = false;  ///< no majority says which of them is right
};
/// One for each such card, of the first case in which it shows.
std::vector<WrongBits> wrong_bits(const Fleet& fleet, const DeviceClass& of);

}  // namespace ptb
