#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/ocl/program.h"
#include "core/render/counted_rows.h"
#include "core/render/film_sums.h"
#include "core/render/parts.h"
#include "core/render/ray_sample.h"
#include "core/render/variant.h"
#include "core/scene/scene.h"

namespace ptb {

/// What pixels have: radiance; what their samples took of a tree, as nodes, triangles and rays in the three
/// channels, by a build of its own, which counts and whose times are not those of the usual one; or what the
/// samples of a gradient-domain integrator say of radiance alone, of how much more the pixel to the right
/// has, and of how much more the one below.
enum class Aov { radiance, cost, primal, dx, dy };
inline constexpr std::array<const char*, 5> aov_names{"radiance", "cost", "primal", "dx", "dy"};
inline bool is_of_gradients(Aov aov) { return aov == Aov::primal || aov == Aov::dx || aov == Aov::dy; }

/// What to render, and how to launch it. The image depends on everything but the launch: work-group, and what
/// `of_image` leaves out of the variant.
struct RenderJob {
    Size size;
    int spp = 1;
    int path_length = 128;
    std::uint32_t seed = 1;
    int lanes = 1;
    int work_group_x = 0, work_group_y = 0;  ///< x == 0: implicit; y == 0: one-dimensional
    Variant variant{};
    /// Samples that a pixel may be ahead of others while the render goes on; a multiple of it is `spp`. 0: as
    /// many as is fastest.
    int round_spp = 0;
    Aov aov = Aov::radiance;
    std::optional<RunCut> cut{};  ///< of an image that several devices make; nothing: what suits this one
};

/// The four timestamps of one launch's event, nanoseconds of the device's clock.
struct LaunchTimes {
    std::uint64_t queued = 0, submit = 0, start = 0, end = 0;
};

/// What a render leaves on the host. Numbers that a kernel does not count are absent.
struct Film {
    Image mean;
    std::optional<Image> variance;  ///< unbiased variance of one sample; needs two samples a pixel
    std::optional<std::uint64_t> samples;
    std::uint64_t segments = 0;
    std::uint64_t shadow_rays = 0;  ///< beside the segments, of integrators that have them
    std::optional<std::uint64_t> full_length_paths;
    std::uint64_t light_segments = 0;  ///< beside them too, of paths that start at lamps or are shifted
    bool reconstructed = false;       ///< made of gradients: of other pixels' noise, too, and perhaps below 0
    bool biased = false;              ///< its mean is not the truth, however many its samples
    std::string hash{};               ///< of its bits on the device (FilmHash)
    std::optional<RaySample> rays{};  ///< where samples are rays of a list
};

/// One scene being rendered on one device: buffers, kernels and how far it has come. Work is done in steps
/// whose size the caller chooses (it knows the clock); the cut never changes the image. Methods throw
/// ocl::Error.
class Render {
  public:
    virtual ~Render() = default;
    /// Back to an empty film with no sample done.
    virtual void restart() = 0;
    /// Pixel samples not rendered yet.
    virtual std::uint64_t samples_left() const = 0;
    /// Enqueues launches for about `samples` further pixel samples (at least the smallest piece), none of
    /// more than that, waits for them and returns their events' times.
    virtual std::vector<LaunchTimes> advance(std::uint64_t samples) = 0;
    /// The film so far; pixels without a sample are black.
    virtual Film read_film() = 0;
    virtual ocl::KernelFacts facts() const = 0;
    virtual std::uint64_t device_bytes() const = 0;
    /// What the kernels did since the film was empty; nothing unless their program is an instrumented build.
    virtual std::optional<Counts> counts() const { return std::nullopt; }
};

/// A render that may be of parts of an image, others of which other devices make.
class PartRender : public Render {
  public:
    virtual RunCut cut() const = 0;
    /// Of the whole image.
    virtual std::uint64_t parts() const = 0;
    /// What is to be rendered next; the film keeps what it has.
    virtual void take(PartRange parts) = 0;
    /// Of what was taken, those not rendered yet.
    virtual PartRange parts_left() const = 0;
    /// Into as many pixels as the image has.
    virtual FilmFacts read_sums(std::span<FilmPixel> pixels) = 0;
};

/// The four timestamps of finished events; zeros where the device does not profile.
std::vector<LaunchTimes> times_of(const std::vector<cl::Event>& events, const ocl::Device& device);

/// Paths of this length that one work-item may trace in one launch, at least: bounded where the device bounds
/// loops (a segment turns once around its own loop and once for every sphere), 0 when it cannot trace even
/// one.
std::uint64_t paths_per_item(const ocl::Device& device, const Scene& scene, int path_length);

/// Ranges for `items` work-items: global sizes are rounded up to whole work-groups.
struct Ranges {
    cl::NDRange global, local;
};
Ranges one_dimensional(std::uint64_t items, int work_group_x);
Ranges two_dimensional(int width, int rows, int work_group_x, int work_group_y);

/// "global 1024x1024, local 32x32", for errors.
std::string describe(const Ranges& ranges);

}  // namespace ptb
