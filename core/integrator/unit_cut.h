#pragma once

#include "core/integrator/runs.h"
#include "core/render/parts.h"

namespace ptb {

/// Units of one launch: those of some pixels' samples of one round, or of whole rounds of the image.
struct UnitPiece {
    std::uint32_t first_pixel = 0, pixels = 0, first_run = 0, units = 0;
    std::uint64_t parts = 0;
};

/// How far an image, or what was taken of its parts, has come: done in order, a piece at a time.
class UnitCut {
  public:
    /// @param max_units  of one piece
    UnitCut(Runs runs, std::uint64_t pixels, std::uint64_t max_units);

    const Runs& runs() const { return runs_; }
    std::uint64_t max_units() const { return max_units_; }
    /// Of the whole image.
    std::uint64_t parts() const { return pixels_ * runs_.round_count(); }
    PartRange left() const { return left_; }
    /// Pixel samples not done yet.
    std::uint64_t samples_left() const { return samples_before(left_.end) - samples_before(left_.first); }
    /// Whole rounds of the image, if `samples` holds one, else a band of pixels of one round.
    UnitPiece next(std::uint64_t samples) const;
    void step_over(const UnitPiece& piece) { left_.first += piece.parts; }
    void take(PartRange parts) { left_ = parts; }
    void restart() { take({0, parts()}); }

  private:
    std::uint32_t whole_rounds(std::uint64_t samples) const;
    UnitPiece rounds(std::uint32_t first, std::uint32_t count) const;
    UnitPiece band(std::uint64_t samples) const;
    std::uint64_t samples_before(std::uint64_t part) const;

    Runs runs_;
    std::uint64_t pixels_, max_units_;
    PartRange left_;
};

}  // namespace ptb
