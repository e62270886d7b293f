// Read before all of a source file: what nlohmann asserts, at every step of an iterator and with every value,
// is counted.
#pragma once

#include <cstddef>

inline std::size_t json_steps = 0;
#define JSON_ASSERT(condition) ((void)++json_steps)
