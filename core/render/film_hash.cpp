#include "core/render/film_hash.h"

#include <fmt/format.h>

namespace ptb {

std::string FilmHash::text() const { return fmt::format("{:016x}", state_); }

}  // namespace ptb
