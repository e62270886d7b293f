#include "core/integrator/unit_cut.h"

#include <algorithm>
#include <utility>

namespace ptb {

UnitCut::UnitCut(Runs runs, std::uint64_t pixels, std::uint64_t max_units)
    : runs_(std::move(runs)), pixels_(pixels), max_units_(std::min(max_units, pixels * runs_.count())) {}

std::uint64_t UnitCut::samples_left() const {
    const std::uint64_t left = runs_.starts.back() - runs_.starts[run_];
    return left == 0 ? 0 : pixels_ * left - pixel_ * runs_.length(run_);
}

UnitPiece UnitCut::next(std::uint64_t samples) const {
    const std::uint32_t runs = pixel_ == 0 ? whole_runs(samples) : 0;
    const std::uint64_t band = std::clamp<std::uint64_t>(samples / runs_.length(run_), 1, max_units_);
    UnitPiece piece;
    piece.first_pixel = static_cast<std::uint32_t>(pixel_);
    piece.pixels = static_cast<std::uint32_t>(runs > 0 ? pixels_ : std::min(band, pixels_ - pixel_));
    piece.first_run = run_;
    piece.units = piece.pixels * std::max(runs, 1u);
    return piece;
}

/// As many as the budget holds, to the end of a round if there is one among them.
std::uint32_t UnitCut::whole_runs(std::uint64_t samples) const {
    const auto& starts = runs_.starts;
    std::uint32_t end = run_, round_end = run_;
    while (end < runs_.count() && (starts[end + 1] - starts[run_]) * pixels_ <= samples &&
           (end + 1 - run_) * pixels_ <= max_units_) {
        if (runs_.ends_round(end)) round_end = end + 1;
        ++end;
    }
    return (round_end > run_ ? round_end : end) - run_;
}

void UnitCut::step_over(const UnitPiece& piece) {
    pixel_ += piece.pixels;
    if (pixel_ < pixels_) return;
    pixel_ = 0;
    run_ += piece.units / piece.pixels;
}

}  // namespace ptb
