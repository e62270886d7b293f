#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/image/image.h"
#include "core/render/counted_rows.h"
#include "core/render/film_sums.h"
#include "core/render/launcher.h"
#include "core/render/render.h"
#include "shared/engine.h"

namespace ptb {

/// As fine as leaves room for the sums of the job's samples of this scene with some to spare: a factor of 16
/// in a pixel's mean radiance over what the scene's emitters can send into it, 64 in the mean of its square;
/// and so much more as samples weigh more that ask one of many lamps, or that roulette spared.
/// @param least_chance  of a lamp that is asked for its light, 1 where none is
FilmScale film_scale(const Scene& scene, const RenderJob& job, double least_chance);

/// What holds the sums of pixels on a device. Methods throw cl::Error.
class FilmStore {
  public:
    virtual ~FilmStore() = default;
    virtual void clear(const cl::CommandQueue& queue) = 0;
    /// Adds the tallies of a launch.
    virtual void add(Launcher& launcher, const cl::Buffer& tallies, const EngineLaunch& launch) = 0;
    /// As many rows as `pixels` has.
    virtual void read(const cl::CommandQueue& queue, int first_row, std::span<FilmPixel> pixels) = 0;
    virtual std::uint64_t bytes() const = 0;
};

/// The kernels that add to it are `integrator`'s, which leave their counts in `counted`.
std::unique_ptr<FilmStore> make_film_store(const ocl::Device& device, const cl::Program& program,
                                           const std::string& integrator, const RenderJob& job,
                                           const CountedRows& counted);

/// Device memory of a film, and its largest object, bytes.
std::uint64_t film_bytes_of(Size size, FilmMemory memory);
std::uint64_t largest_film_object(Size size, FilmMemory memory);

/// Why the device cannot hold such a film, or nothing.
std::string film_refusal(const ocl::Device& device, Size size, FilmMemory memory);

}  // namespace ptb
