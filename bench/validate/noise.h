#pragma once

#include "bench/validate/validate.h"

namespace ptb {

/// The relMSE of an image whose pixels are independent: of each pixel the mean over its channels of
/// variance / (mean^2 + 0.01 median^2), mean and median those of the reference, the median being that of the
/// channel over all pixels; then the mean over pixels. The variance is the film's, of one sample, over the
/// samples of a pixel; the reference's where the film holds none. Numbers that cannot be given have a reason.
Efficiency noise_of(const FilmEvidence& evidence, const Reference& reference);

/// Adds 1 / (relMSE x seconds) with its 95 % interval, in which the errors of noise and time come together as
/// independent ones; a time without an interval leaves it out.
void add_efficiency(Efficiency& efficiency, const Statistics& statistics);

}  // namespace ptb
