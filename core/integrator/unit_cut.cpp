#include "core/integrator/unit_cut.h"

#include <algorithm>
#include <utility>

namespace ptb {

UnitCut::UnitCut(Runs runs, std::uint64_t pixels, std::uint64_t max_units)
    : runs_(std::move(runs)), pixels_(pixels), max_units_(std::min(max_units, pixels * runs_.count())) {
    restart();
}

std::uint64_t UnitCut::samples_before(std::uint64_t part) const {
    const auto round = static_cast<std::uint32_t>(part / pixels_);
    const std::uint64_t before = runs_.samples_before(round), pixel = part % pixels_;
    return pixels_ * before + (pixel == 0 ? 0 : pixel * (runs_.samples_before(round + 1) - before));
}

UnitPiece UnitCut::next(std::uint64_t samples) const {
    const std::uint32_t whole = left_.first % pixels_ == 0 ? whole_rounds(samples) : 0;
    return whole > 0 ? rounds(static_cast<std::uint32_t>(left_.first / pixels_), whole) : band(samples);
}

/// As many as the budget holds, and a launch.
std::uint32_t UnitCut::whole_rounds(std::uint64_t samples) const {
    const auto first = static_cast<std::uint32_t>(left_.first / pixels_);
    const auto last = static_cast<std::uint32_t>(left_.end / pixels_);
    std::uint32_t end = first;
    while (end < last && (runs_.samples_before(end + 1) - runs_.samples_before(first)) * pixels_ <= samples &&
           (runs_.rounds[end + 1] - runs_.rounds[first]) * pixels_ <= max_units_)
        ++end;
    return end - first;
}

UnitPiece UnitCut::rounds(std::uint32_t first, std::uint32_t count) const {
    UnitPiece piece;
    piece.pixels = static_cast<std::uint32_t>(pixels_);
    piece.first_run = runs_.rounds[first];
    piece.units = piece.pixels * (runs_.rounds[first + count] - piece.first_run);
    piece.parts = pixels_ * count;
    return piece;
}

UnitPiece UnitCut::band(std::uint64_t samples) const {
    const auto round = static_cast<std::uint32_t>(left_.first / pixels_);
    const std::uint64_t pixel = left_.first % pixels_;
    const std::uint32_t length = runs_.samples_before(round + 1) - runs_.samples_before(round);
    const std::uint32_t runs = runs_.rounds[round + 1] - runs_.rounds[round];
    const std::uint64_t held = std::clamp<std::uint64_t>(samples / length, 1, max_units_ / runs);
    UnitPiece piece;
    piece.first_pixel = static_cast<std::uint32_t>(pixel);
    piece.pixels = static_cast<std::uint32_t>(std::min({held, pixels_ - pixel, left_.end - left_.first}));
    piece.first_run = runs_.rounds[round];
    piece.units = piece.pixels * runs;
    piece.parts = piece.pixels;
    return piece;
}

}  // namespace ptb
