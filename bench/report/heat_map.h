#pragma once

#include "core/image/image.h"

namespace ptb {

/// What a picture of costs shows (Aov::cost): the nodes of a sample, from black for none over red and
/// yellow to white.
struct HeatMap {
    Image image;
    double white = 1;  ///< nodes: the smallest power of two that 99 % of the pixels keep under
    double least = 0, mean = 0, most = 0;
};

HeatMap heat_map(const Image& cost);

}  // namespace ptb
