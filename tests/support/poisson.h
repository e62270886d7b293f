#pragma once

#include <vector>

#include "core/image/image.h"

namespace ptb {

/// Numbers of one colour, in rows from the top: of pixels, and how much more the right neighbour has, and the
/// one below. Those of the last column, and row, mean nothing.
struct Differences {
    Size size;
    std::vector<double> pixels, across, down;
};

/// The picture I where the sum of alpha^2 (I - pixels)^2, (right - I - across)^2 and (below - I - down)^2 is
/// least, by a discrete cosine transform: see "GradientShop", by P. Bhat, C. L. Zitnick, M. Cohen and
/// B. Curless.
std::vector<double> least_squares(const Differences& differences, double alpha);

/// That sum, of any picture.
double squared_errors(const Differences& differences, double alpha, const std::vector<double>& picture);

/// A picture with its own differences.
Differences differences_of(Size size, const std::vector<double>& picture);

}  // namespace ptb
