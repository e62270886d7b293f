#pragma once

#include <filesystem>

#include "core/render/film_sums.h"

namespace ptb {

/// The sums of a film as a file: one line of JSON that describes them, then the pixels as they lie in memory.
/// Throws std::runtime_error with the file and the reason.
void write_film(const std::filesystem::path& file, const FilmSums& sums);
FilmSums read_film(const std::filesystem::path& file);

}  // namespace ptb
