#pragma once

#include <array>
#include <vector>

#include "bench/validate/blocks.h"
#include "core/render/render.h"

namespace ptb {

/// Renders of the same work that differ in their seeds alone. Where pixels share paths, they tell the errors
/// of a film, which the variance of its samples does not.
struct Passes {
    int spp = 1;  ///< of each
    std::vector<Film> films;

    double degrees() const { return static_cast<double>(films.size()) - 1; }
};

/// So many tell a standard error to 13 %.
inline constexpr int enough_passes = 32;

/// Their mean, and the sums of their counts.
Film together(const Passes& passes);

/// Variance of the mean of blocks of pixels, and of the image, times the samples that the mean is of.
Blocks block_variance_of_sample(const Passes& passes, int edge);
std::array<double, 3> image_variance_of_sample(const Passes& passes);

/// How many standard errors of a normal number are as unlikely as this difference, whose variance is partly
/// known and partly estimated with these degrees of freedom: see "The Generalization of 'Student's' Problem
/// when Several Different Population Variances are Involved", by B. L. Welch.
double student_z(double difference, double known_variance, double estimated_variance, double degrees);

}  // namespace ptb
