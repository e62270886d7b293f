#pragma once

#include <string>
#include <vector>

#include "core/mesh/geometry.h"

namespace ptb {

/// A mesh made from a formula, the same on every machine. Each step of detail has about four times as many
/// triangles (the sponge: twenty times).
struct Shape {
    std::string name;
    int most_detail = 0;  ///< the least is 0
    Geometry (*make)(int detail) = nullptr;
};

const std::vector<Shape>& shapes();

}  // namespace ptb
