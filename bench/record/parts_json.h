#pragma once

#include "bench/record/fields.h"
#include "core/render/parts.h"

namespace ptb {

template <>
inline constexpr auto fields<RunCut> = std::make_tuple(required("fair", &RunCut::fair),
                                                       required("most", &RunCut::most));

/// A range is a pair: the first part, and the one after the last.
inline Json encode(const PartRange& range) { return Json::array({range.first, range.end}); }

inline void decode(const Json& json, const Where& where, PartRange& range) {
    if (!json.is_array() || json.size() != 2)
        where.refuse(json, "a pair: the first part, and the one after the last");
    decode(json[0], Where(where, std::size_t{0}), range.first);
    decode(json[1], Where(where, std::size_t{1}), range.end);
}

}  // namespace ptb
