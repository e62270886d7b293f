#pragma once

#include "core/integrator/runs.h"

namespace ptb {

/// Units of one launch: a band of pixels of one run, or whole runs of the image.
struct UnitPiece {
    std::uint32_t first_pixel = 0, pixels = 0, first_run = 0, units = 0;
};

/// How far an image has come: its pixels' runs of samples, done in order, a piece at a time.
class UnitCut {
  public:
    /// @param max_units  of one piece
    UnitCut(Runs runs, std::uint64_t pixels, std::uint64_t max_units);

    const Runs& runs() const { return runs_; }
    std::uint64_t max_units() const { return max_units_; }
    /// Pixel samples not done yet.
    std::uint64_t samples_left() const;
    /// Whole runs of the image, if `samples` holds one, else a band of pixels of one run.
    UnitPiece next(std::uint64_t samples) const;
    void step_over(const UnitPiece& piece);
    void restart() { pixel_ = run_ = 0; }

  private:
    std::uint32_t whole_runs(std::uint64_t samples) const;

    Runs runs_;
    std::uint64_t pixels_, max_units_;
    std::uint64_t pixel_ = 0;  ///< the next one
    std::uint32_t run_ = 0;    ///< of its samples
};

}  // namespace ptb
