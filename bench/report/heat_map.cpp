#include "bench/report/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace ptb {
namespace {

using Colour = std::array<double, 3>;

/// Of equal steps, as a file holds them: each is lighter than the one before, in grey too.
constexpr std::array<Colour, 6> stops = {
    {{0, 0, 0}, {0.25, 0.03, 0.42}, {0.65, 0.1, 0.35}, {0.93, 0.38, 0.1}, {0.99, 0.75, 0.2}, {1, 1, 1}}};

Colour colour_at(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double along = place - static_cast<double>(stop);
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) colour[c] = std::lerp(stops[stop][c], stops[stop + 1][c], along);
    return colour;
}

std::vector<double> nodes_of(const Image& cost) {
    std::vector<double> nodes;
    for (std::size_t i = 0; i < cost.rgb.size(); i += 3) nodes.push_back(static_cast<double>(cost.rgb[i]));
    return nodes;
}

double white_of(std::vector<double> nodes) {
    const auto at = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(nodes.size() - 1));
    std::nth_element(nodes.begin(), nodes.begin() + at, nodes.end());
    return std::exp2(std::ceil(std::log2(std::max(nodes[static_cast<std::size_t>(at)], 1.0))));
}

}  // namespace

HeatMap heat_map(const Image& cost) {
    const std::vector<double> nodes = nodes_of(cost);
    HeatMap map{{cost.size, {}}, white_of(nodes), 0, 0, 0};
    const auto [least, most] = std::minmax_element(nodes.begin(), nodes.end());
    map.least = *least;
    map.most = *most;
    map.mean = std::accumulate(nodes.begin(), nodes.end(), 0.0) / static_cast<double>(nodes.size());
    for (const double each : nodes)
        for (const double value : colour_at(each / map.white))
            map.image.rgb.push_back(static_cast<float>(value * value));  // write_image takes the root
    return map;
}

}  // namespace ptb
