#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/fleet/plan.h"

namespace ptb {

/// What one device made of one case, as far as a fleet asks.
struct CardCase {
    std::size_t work = 0;  ///< of Fleet::works
    Status status = Status::skipped;
    std::optional<double> log_ns;  ///< of the median, where the case has a time
    std::string film_hash;         ///< of the timed image, or empty
};

/// One device of a fleet.
struct Card {
    std::string node;
    DeviceInfo device;
    std::vector<CardCase> cases;
    std::size_t planned = 0;        ///< cases that it was to measure
    std::optional<GpuState> state;  ///< after its last case that has one
};

struct FleetNode {
    std::string name;
    HostInfo host;
    std::size_t planned = 0, recorded = 0;
    bool finished = false;
    std::optional<Lease> lease;
    std::string refused;  ///< why it took no part, or empty
    bool has_journal = false;
};

/// What there is of a fleet, without what is long: samples, logs.
struct Fleet {
    FleetPlan plan;
    std::vector<Case> works;       ///< cases without their device; launches as they ran
    std::vector<Card> cards;       ///< by node, in its order
    std::vector<FleetNode> nodes;  ///< all that are expected, sorted
};

/// Hears of each node's run, in the order of nodes.
using NodeRead = std::function<void(const std::string& node, const ResultFile& run)>;

/// Reads all journals, one at a time. Throws UsageError.
Fleet read_fleet(const FleetFolder& folder, const NodeRead& also = {});

/// "n1/nvidia:0"
std::string label(const Card& card);

}  // namespace ptb
