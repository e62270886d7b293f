/* Scalars and vectors of the structs that host and device share: one spelling for both compilers. Only
   scalars of 4 and 8 bytes and 16-byte vectors, padding is explicit, and every struct asserts its size on the line after
   it. */
#ifndef PTB_SHARED_TYPES_H
#define PTB_SHARED_TYPES_H

#ifdef __OPENCL_C_VERSION__

typedef float4 ptb_float4;
typedef uint ptb_uint;
typedef int ptb_int;
typedef long ptb_long;
#define PTB_ASSERT_SIZE(type, bytes) typedef char type##_has_##bytes##_bytes[sizeof(type) == (bytes) ? 1 : -1]

#else

#include <cstdint>

struct alignas(16) ptb_float4 {
    float x, y, z, w;
};
using ptb_uint = std::uint32_t;
using ptb_int = std::int32_t;
using ptb_long = std::int64_t;
#define PTB_ASSERT_SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type " differs between compilers")

#endif
#endif
