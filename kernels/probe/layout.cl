/* `probe_layout`: how this device's compiler lays the shared structs out: the size of each struct and the offset of each
   of its fields, in the order of fields.h. One work-item. */
#include "probe/fields.h"

#define WRITE_SIZE(type) out[at++] = (uint)sizeof(type);
#define WRITE_OFFSET(type, field)                                              \
    {                                                                          \
        type it;                                                               \
        out[at++] = (uint)((const char*)&it.field - (const char*)&it);         \
    }

__kernel void probe_layout(__global uint* out) {
    uint at = 0;
    PTB_SHARED_FIELDS(WRITE_SIZE, WRITE_OFFSET)
}
