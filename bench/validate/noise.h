#pragma once

#include <vector>

#include "bench/validate/blocks.h"
#include "bench/validate/validate.h"

namespace ptb {

/// The relMSE of an image whose pixels are independent: of each pixel the mean over its channels of
/// variance / (mean^2 + 0.01 median^2), mean and median those of the reference, the median being that of the
/// channel over all pixels; then the mean over pixels. The variance is the film's, of one sample, over the
/// samples of a pixel; the reference's where the film holds none. Numbers that cannot be given have a reason.
Efficiency noise_of(const FilmEvidence& evidence, const Reference& reference);

/// The same of images whose pixels share paths, by pairs of independent renders: half the squared difference
/// of both is as good an estimate of a pixel's variance as its pair allows, and standard errors are those
/// over pairs, since pixels are not independent.
class PairedNoise {
  public:
    /// Of an image of this size and of so many samples a pixel, by renders of `pass_spp`.
    PairedNoise(const Reference& reference, Size size, int spp, int pass_spp);
    /// Why there is none, or nothing.
    const std::string& refusal() const { return refusal_; }
    void add(const Image& first, const Image& second);
    /// Of at least two pairs.
    Efficiency noise() const;

  private:
    std::string refusal_;
    std::vector<double> weights_;             ///< of the squared differences in all pixels' channels
    std::vector<std::vector<float>> errors_;  ///< of each pair, those of pixels
};

/// Adds 1 / (relMSE x seconds) with its 95 % interval, in which the errors of noise and time come together as
/// independent ones; a time without an interval leaves it out.
void add_efficiency(Efficiency& efficiency, const Statistics& statistics);

}  // namespace ptb
