#pragma once

#include <memory>
#include <span>

#include "bench/workbench/pace.h"

namespace ptb {

/// Parts that were rendered, and what that took.
struct PartsDone {
    PartRange parts;  ///< of those asked for, from the first on
    double host_s = 0, device_s = 0;
};

/// What one device makes of a picture that several share. Throws what goes wrong.
class PictureParts {
  public:
    /// `pace` outlives it. Throws Unsupported where nobody can make parts of such a picture.
    PictureParts(Builds& builds, Pace& pace, const CaseJob& job);

    RunCut cut() const { return render_->cut(); }
    std::uint64_t count() const { return render_->parts(); }  ///< of the whole picture

    /// Adds parts to the film. `progress` answers whether to go on.
    PartsDone render(PartRange parts, const Progress& progress);

    /// The film into as many pixels as the image has; it is empty then.
    FilmFacts take_film(std::span<FilmPixel> pixels);

  private:
    Pace& pace_;
    CaseJob job_;
    std::unique_ptr<PartRender> render_;
};

}  // namespace ptb
