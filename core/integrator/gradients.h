#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/integrator/runs.h"
#include "core/render/film_sums.h"
#include "core/render/launcher.h"
#include "core/render/render.h"
#include "shared/gradients.h"

namespace ptb {

/// What samples say of differences between pixels, on a device, and the kernels that make a picture of them.
/// Methods throw cl::Error.
class GradientStore {
  public:
    GradientStore(const ocl::Device& device, const cl::Program& program, const std::string& integrator,
                  const RenderJob& job, const FilmScale& scale);

    /// GradientPixel: of the first half of the samples in rows from the top, then of the second.
    const cl::Buffer& sums() const { return sums_; }
    void clear(const cl::CommandQueue& queue);
    /// Enqueues what makes the picture of so many samples a pixel, unless it is made of them already.
    void reconstruct(Launcher& launcher, std::uint32_t samples);
    /// The picture, or what the job asks for in its place, of so many samples a pixel, which `sums` are
    /// those of; reconstructs it where that was not done.
    Image picture(Launcher& launcher, std::uint32_t samples, const std::vector<GradientPixel>& sums);
    std::vector<GradientPixel> read_sums(const cl::CommandQueue& queue) const;
    std::uint64_t bytes() const { return gradient_bytes_of(size_, method_); }

    /// Device memory, and its largest object, bytes.
    static std::uint64_t gradient_bytes_of(Size size, Reconstruction method);
    static std::uint64_t largest_object(Size size);

  private:
    void solve(Launcher& launcher, int turns);
    void reweighed(Launcher& launcher);
    template <class... Arguments>
    void launch(Launcher& launcher, cl::Kernel& kernel, std::uint64_t groups, const Arguments&... arguments);
    void total(Launcher& launcher, cl_uint place);
    bool reconstructs() const;

    Size size_;
    Reconstruction method_;
    Aov aov_;
    ReconstructLaunch launch_{};
    std::uint32_t made_of_ = 0;  ///< samples a pixel of the picture
    cl::Kernel measure_, total_, give_, reweigh_, begin_, apply_, step_, turn_, picture_;
    cl::Buffer sums_, given_, solution_, residual_, way_, applied_, partials_, scalars_;
};

/// Of runs of samples those with even and with odd numbers, which belong to either half, are as long but for
/// one sample: the same of twice the runs.
Runs in_halves(std::uint32_t spp, const RunCut& cut);

}  // namespace ptb
