#include "core/integrator/gradients.h"

#include <algorithm>
#include <cmath>

#include "core/integrator/runs.h"

namespace ptb {

namespace {

/// Of conjugate gradients. With weights the picture no longer changes after some twenty: they make pixels
/// with noisy neighbours stand for themselves.
constexpr int turns_weighted = 30, turns_plain = 50, turns_reweighed = 20;
constexpr int reweighings = 12;
/// What least absolute errors are blunted by at first, in units of the mean brightness; half as much each
/// time.
constexpr float first_nearness = 0.05f;

constexpr std::uint64_t texel = 4 * sizeof(float);

std::uint32_t first_half(std::uint32_t samples) { return (samples + 1) / 2; }

}  // namespace

GradientStore::GradientStore(const ocl::Device& device, const cl::Program& program,
                             const std::string& integrator, const RenderJob& job, const FilmScale& scale)
    : size_(job.size), method_(job.variant.reconstruction), aov_(job.aov) {
    const std::uint64_t pixels = size_.pixels();
    launch_.width = static_cast<std::uint32_t>(size_.width);
    launch_.height = static_cast<std::uint32_t>(size_.height);
    constexpr std::uint64_t of_group = RECONSTRUCT_GROUP * RECONSTRUCT_EACH;
    launch_.groups = static_cast<std::uint32_t>((pixels + of_group - 1) / of_group);
    launch_.radiance_scale = std::ldexp(1.0f, scale.radiance);
    launch_.squares_scale = std::ldexp(1.0f, scale.squares);
    const auto buffer = [&](std::uint64_t bytes) {
        return cl::Buffer(device.context, CL_MEM_READ_WRITE, bytes);
    };
    sums_ = buffer(2 * pixels * sizeof(GradientPixel));
    if (!reconstructs()) return;
    const auto kernel = [&](const char* verb) { return cl::Kernel(program, (integrator + verb).c_str()); };
    measure_ = kernel("_measure"), total_ = kernel("_total"), give_ = kernel("_give");
    reweigh_ = kernel("_reweigh"), begin_ = kernel("_begin"), apply_ = kernel("_apply");
    step_ = kernel("_step"), turn_ = kernel("_turn"), picture_ = kernel("_picture");
    given_ = buffer(2 * 3 * pixels * texel);
    for (cl::Buffer* each : {&solution_, &residual_, &way_, &applied_}) *each = buffer(2 * pixels * texel);
    partials_ = buffer(2ull * launch_.groups * texel);
    scalars_ = buffer(2ull * RECONSTRUCT_SCALARS * texel);
}

bool GradientStore::reconstructs() const { return method_ != Reconstruction::none && !is_of_gradients(aov_); }

void GradientStore::clear(const cl::CommandQueue& queue) {
    queue.enqueueFillBuffer(sums_, 0u, 0, 2 * size_.pixels() * sizeof(GradientPixel));
    made_of_ = 0;
}

template <class... Arguments>
void GradientStore::launch(Launcher& launcher, cl::Kernel& kernel, std::uint64_t groups,
                           const Arguments&... arguments) {
    cl_uint i = 0;
    (kernel.setArg(i++, arguments), ...);
    kernel.setArg(i, launch_);
    launcher.barrier();
    launcher.launch(kernel, {cl::NDRange(groups * RECONSTRUCT_GROUP), cl::NDRange(RECONSTRUCT_GROUP)});
}

void GradientStore::total(Launcher& launcher, cl_uint place) {
    launch(launcher, total_, launch_.problems, partials_, scalars_, place);
}

/// From the solution so far.
void GradientStore::solve(Launcher& launcher, int turns) {
    const std::uint64_t groups = static_cast<std::uint64_t>(launch_.groups) * launch_.problems;
    launch(launcher, begin_, groups, given_, solution_, residual_, way_, partials_);
    total(launcher, RECONSTRUCT_RESIDUAL);
    for (cl_uint turn = 0; turn < static_cast<cl_uint>(turns); ++turn) {
        launch(launcher, apply_, groups, given_, way_, applied_, partials_);
        total(launcher, RECONSTRUCT_APPLIED);
        launch(launcher, step_, groups, given_, solution_, residual_, way_, applied_, scalars_, partials_,
               turn);
        total(launcher, RECONSTRUCT_RESIDUAL + (turn + 1) % 2);
        launch(launcher, turn_, groups, given_, residual_, way_, scalars_, turn);
    }
}

/// Least absolute errors, by least squares whose weights are told anew.
void GradientStore::reweighed(Launcher& launcher) {
    float nearness = first_nearness;
    for (int i = 0; i < reweighings; ++i, nearness /= 2) {
        launch(launcher, reweigh_, launch_.groups, given_, solution_, scalars_, nearness);
        solve(launcher, turns_reweighed);
    }
}

void GradientStore::reconstruct(Launcher& launcher, std::uint32_t samples) {
    if (!reconstructs() || samples == 0 || made_of_ == samples) return;
    made_of_ = samples;
    launch_.samples[0] = first_half(samples);
    launch_.samples[1] = samples - first_half(samples);
    launch_.problems = 1;
    launch(launcher, measure_, launch_.groups, sums_, partials_);
    total(launcher, RECONSTRUCT_MEASURED);
    // A lone sample has no other half to tell its variance.
    if (method_ == Reconstruction::weighted && samples > 1) launch_.problems = 2;
    const std::uint64_t groups = static_cast<std::uint64_t>(launch_.groups) * launch_.problems;
    launch(launcher, give_, groups, sums_, given_, solution_, scalars_);
    solve(launcher, launch_.problems == 2 ? turns_weighted : turns_plain);
    if (method_ == Reconstruction::l1) reweighed(launcher);
    if (launch_.problems == 2) launch(launcher, picture_, launch_.groups, solution_);
}

std::vector<GradientPixel> GradientStore::read_sums(const cl::CommandQueue& queue) const {
    std::vector<GradientPixel> sums(2 * size_.pixels());
    queue.enqueueReadBuffer(sums_, CL_TRUE, 0, sums.size() * sizeof(GradientPixel), sums.data());
    return sums;
}

Image GradientStore::picture(Launcher& launcher, std::uint32_t samples,
                             const std::vector<GradientPixel>& sums) {
    Image image{size_, std::vector<float>(size_.pixels() * 3)};
    if (samples == 0) return image;
    if (reconstructs()) {
        reconstruct(launcher, samples);
        std::vector<cl_float4> texels(size_.pixels());
        launcher.queue().enqueueReadBuffer(solution_, CL_TRUE, 0, texels.size() * sizeof(cl_float4),
                                           texels.data());
        for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = texels[i / 3].s[i % 3];
        return image;
    }
    const ptb_long(GradientPixel::*kind)[3] = aov_ == Aov::dx   ? &GradientPixel::across
                                              : aov_ == Aov::dy ? &GradientPixel::down
                                                                : &GradientPixel::radiance;
    const double unit = 1.0 / (static_cast<double>(launch_.radiance_scale) * samples);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        const std::size_t pixel = i / 3, c = i % 3;
        const ptb_long sum = (sums[pixel].*kind)[c] + (sums[pixel + size_.pixels()].*kind)[c];
        image.rgb[i] = static_cast<float>(static_cast<double>(sum) * unit);
    }
    return image;
}

std::uint64_t GradientStore::largest_object(Size size) {
    return 2 * size.pixels() * std::max(sizeof(GradientPixel), 3 * texel);
}

std::uint64_t GradientStore::gradient_bytes_of(Size size, Reconstruction method) {
    const std::uint64_t solved = method == Reconstruction::none ? 0 : 7 * texel;
    return 2 * size.pixels() * (sizeof(GradientPixel) + solved);
}

Runs in_halves(std::uint32_t spp, const RunCut& cut) {
    Runs runs{{0}, {0}};
    if (spp > 1) {
        const Runs half = make_runs(spp / 2, std::max<std::uint64_t>(cut.fair / 2, 1),
                                    std::max<std::uint64_t>(cut.most / 2, 1));
        for (std::uint32_t i = 0; i < half.count(); ++i)
            for (int twice = 0; twice < 2; ++twice)
                runs.starts.push_back(runs.starts.back() + half.length(i));
        for (std::size_t i = 1; i < half.rounds.size(); ++i) runs.rounds.push_back(2 * half.rounds[i]);
    }
    if (spp % 2 == 1) {
        runs.starts.push_back(spp);
        runs.rounds.push_back(runs.count());
    }
    return runs;
}

}  // namespace ptb
