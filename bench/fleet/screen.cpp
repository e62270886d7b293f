#include "bench/fleet/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace ptb {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double mads =
    3 * 1.4826;  ///< 1.4826 median absolute deviations of normal values are one standard deviation

std::vector<double> without_nan(std::span<const double> values) {
    std::vector<double> kept;
    std::copy_if(values.begin(), values.end(), std::back_inserter(kept),
                 [](double value) { return !std::isnan(value); });
    return kept;
}

std::vector<double> medians_of_works(const LogTimes& times) {
    std::vector<double> medians;
    for (std::size_t work = 0; !times.empty() && work < times.front().size(); ++work) {
        std::vector<double> of_work;
        for (const auto& card : times) of_work.push_back(card[work]);
        medians.push_back(median_of(without_nan(of_work)));
    }
    return medians;
}

double mean_of_known(std::span<const double> values) {
    const std::vector<double> known = without_nan(values);
    if (known.empty()) return nothing;
    return std::accumulate(known.begin(), known.end(), 0.0) / static_cast<double>(known.size());
}

/// The median deviation of each node's cards.
std::map<std::string, double> nodes_of(std::span<const double> deviation,
                                       const std::vector<std::string>& node_of_card) {
    std::map<std::string, std::vector<double>> cards;
    for (std::size_t i = 0; i < deviation.size(); ++i)
        if (!std::isnan(deviation[i])) cards[node_of_card[i]].push_back(deviation[i]);
    std::map<std::string, double> nodes;
    for (auto& [node, deviations] : cards) nodes[node] = median_of(std::move(deviations));
    return nodes;
}

std::vector<std::string> slow_nodes(std::span<const double> deviation,
                                    const std::vector<std::string>& node_of_card) {
    const auto nodes = nodes_of(deviation, node_of_card);
    std::vector<std::string> names, slow;
    std::vector<double> values;
    for (const auto& [node, value] : nodes) {
        names.push_back(node);
        values.push_back(value);
    }
    if (names.size() < fewest_cards) return {};
    for (const std::size_t i : outliers(values)) slow.push_back(names[i]);
    return slow;
}

}  // namespace

double median_of(std::vector<double> values) {
    if (values.empty()) return nothing;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::vector<double> deviations(const LogTimes& times) {
    const std::vector<double> medians = medians_of_works(times);
    std::vector<double> found;
    for (const auto& card : times) {
        std::vector<double> of_works;
        for (std::size_t work = 0; work < card.size(); ++work)
            if (!std::isnan(card[work])) of_works.push_back(card[work] - medians[work]);
        found.push_back(median_of(std::move(of_works)));
    }
    return found;
}

std::vector<std::size_t> outliers(std::span<const double> deviations) {
    const std::vector<double> known = without_nan(deviations);
    const double middle = median_of(known);
    std::vector<double> distances;
    for (const double value : known) distances.push_back(std::abs(value - middle));
    const double limit = std::max(std::log1p(slow_by), mads * median_of(std::move(distances)));
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < deviations.size(); ++i)
        if (deviations[i] - middle > limit) found.push_back(i);
    return found;
}

Screened screen(const LogTimes& times, const std::vector<std::string>& node_of_card) {
    Screened screened{deviations(times), mean_of_known(medians_of_works(times)), {}, {}, false};
    screened.too_few = without_nan(screened.deviation).size() < fewest_cards;
    if (screened.too_few) return screened;
    screened.slow_nodes = slow_nodes(screened.deviation, node_of_card);
    std::set<std::size_t> candidates;
    for (const std::size_t i : outliers(screened.deviation)) candidates.insert(i);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const auto& slow = screened.slow_nodes;
        const bool on_slow_node = std::find(slow.begin(), slow.end(), node_of_card[i]) != slow.end();
        if (on_slow_node && !std::isnan(screened.deviation[i])) candidates.insert(i);
    }
    screened.candidates.assign(candidates.begin(), candidates.end());
    return screened;
}

Screened screen(const Fleet& fleet, const DeviceClass& of) {
    LogTimes times;
    std::vector<std::string> nodes;
    for (const std::size_t i : of.cards) {
        auto& row = times.emplace_back(fleet.works.size(), nothing);
        for (const CardCase& c : fleet.cards[i].cases)
            if (c.log_ns) row[c.work] = *c.log_ns;
        nodes.push_back(fleet.cards[i].node);
    }
    return screen(times, nodes);
}

}  // namespace ptb
