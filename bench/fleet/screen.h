#pragma once

#include <span>
#include <vector>

#include "bench/fleet/classes.h"

namespace ptb {

inline constexpr double slow_by = 0.03;         ///< what counts as slow, at least
inline constexpr std::size_t fewest_cards = 5;  ///< below, nobody can say which of them is slow

/// The times of the cards of one class, in the class' order: of each work its log time, NaN where there is
/// none.
using LogTimes = std::vector<std::vector<double>>;

/// How much slower each card is than its class: the median over works of its log time less the median of all
/// cards; NaN for a card without a time.
std::vector<double> deviations(const LogTimes& times);

/// Values that lie above the median of all by more than 3 % and three robust standard deviations.
std::vector<std::size_t> outliers(std::span<const double> deviations);

/// What the first stage finds in a class. Deviations are of log time, from the class' median.
struct Screened {
    std::vector<double> deviation;        ///< of its cards
    double typical_log_ns = 0;            ///< the class' medians of its works, their mean; NaN without a time
    std::vector<std::size_t> candidates;  ///< places in its cards: slow ones, and all of slow nodes
    std::vector<std::string> slow_nodes;
    bool too_few = false;
};
Screened screen(const LogTimes& times, const std::vector<std::string>& node_of_card);
Screened screen(const Fleet& fleet, const DeviceClass& of);

/// Of a sorted or unsorted list without NaN; NaN for an empty one.
double median_of(std::vector<double> values);

}  // namespace ptb
