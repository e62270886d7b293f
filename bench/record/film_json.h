#pragma once

#include "bench/record/json.h"
#include "core/render/film_sums.h"

namespace ptb {

template <>
inline constexpr auto fields<FilmScale> = std::make_tuple(required("radiance", &FilmScale::radiance),
                                                          required("squares", &FilmScale::squares));

template <>
inline constexpr auto fields<FilmFacts> = std::make_tuple(
    required("size", &FilmFacts::size), required("scale", &FilmFacts::scale),
    required("variance", &FilmFacts::has_variance), required("light_segments", &FilmFacts::light_segments));

}  // namespace ptb
