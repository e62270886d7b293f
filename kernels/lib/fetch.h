/* Memory that will soon be read. */
#ifndef PTB_LIB_FETCH_H
#define PTB_LIB_FETCH_H

#include "lib/machine.h"

#define FETCH_LINE 64u /* bytes */

/* Has the lines of these bytes fetched from now on. (OpenCL's prefetch does nothing with PoCL.) */
static inline void fetch_early(__global const void* begin, uint bytes) {
#if defined(__x86_64__) && PTB_HAS(__builtin_prefetch)
    for (uint line = 0u; line < bytes; line += FETCH_LINE) __builtin_prefetch((__global const char*)begin + line);
#else
    (void)begin, (void)bytes;
#endif
}

#endif
