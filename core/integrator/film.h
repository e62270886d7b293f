#pragma once

#include <memory>
#include <vector>

#include "core/image/image.h"
#include "core/render/counted_rows.h"
#include "core/render/launcher.h"
#include "shared/engine.h"

namespace ptb {

/// What holds the sums of `pt`'s pixels on a device. Methods throw cl::Error.
class FilmStore {
  public:
    virtual ~FilmStore() = default;
    virtual void clear(const cl::CommandQueue& queue) = 0;
    /// Adds the tallies of a launch.
    virtual void add(Launcher& launcher, const cl::Buffer& tallies, const EngineLaunch& launch) = 0;
    /// One tally a pixel of these rows: a large film would take twice its size on the host at once.
    virtual std::vector<Tally> read(const cl::CommandQueue& queue, int first_row, int rows) = 0;
    virtual std::uint64_t bytes() const = 0;
};

/// Its kernel leaves its counts in `counted`.
std::unique_ptr<FilmStore> make_film_store(const ocl::Device& device, const cl::Program& program, Size size,
                                     FilmMemory memory, const CountedRows& counted);

/// Device memory of a film, and its largest object, bytes.
std::uint64_t film_bytes_of(Size size, FilmMemory memory);
std::uint64_t largest_film_object(Size size, FilmMemory memory);

/// Why the device cannot hold such a film, or nothing.
std::string film_refusal(const ocl::Device& device, Size size, FilmMemory memory);

}  // namespace ptb
