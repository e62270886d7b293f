/* Tables of 16 floats that every lane reads at its own index, by register permutes where the machine has them; and how
   lanes read rows of memory of their own. */
#ifndef PTB_LIB_TABLE_H
#define PTB_LIB_TABLE_H

#include "lib/lanes.h"

#define TABLE_ROWS 16

typedef struct Table {
    float16 row;
} Table;

/* Of each lane's own row of an array, the row itself or its .member, as a vector of this type. (Lanes written one by one
   would wait for those stores when they are read: 1.3 at 10 SPP, two AVX-512 cores, PoCL.) */
#define LANES_GATHER_4(type, rows, index, member) \
    (type##4)((rows)[(index).s0]member, (rows)[(index).s1]member, (rows)[(index).s2]member, (rows)[(index).s3]member)
#define LANES_GATHER_8(type, rows, index, member)                                                                     \
    (type##8)((rows)[(index).s0]member, (rows)[(index).s1]member, (rows)[(index).s2]member, (rows)[(index).s3]member, \
              (rows)[(index).s4]member, (rows)[(index).s5]member, (rows)[(index).s6]member, (rows)[(index).s7]member)
#define LANES_GATHER_16(type, rows, index, member)                                                                     \
    (type##16)((rows)[(index).s0]member, (rows)[(index).s1]member, (rows)[(index).s2]member, (rows)[(index).s3]member, \
               (rows)[(index).s4]member, (rows)[(index).s5]member, (rows)[(index).s6]member, (rows)[(index).s7]member, \
               (rows)[(index).s8]member, (rows)[(index).s9]member, (rows)[(index).sa]member, (rows)[(index).sb]member, \
               (rows)[(index).sc]member, (rows)[(index).sd]member, (rows)[(index).se]member, (rows)[(index).sf]member)
#define LANES_GATHER_32(type, rows, index, member) \
    (type##32)(LANES_GATHER_16(type, rows, (index).lo, member), LANES_GATHER_16(type, rows, (index).hi, member))
#if PTB_LANES == 1
#define LANES_GATHER(type, rows, index, member) ((rows)[index] member)
#else
#define LANES_GATHER(type, rows, index, member) (PTB_GLUE(LANES_GATHER_, PTB_LANES)(type, rows, index, member))
#endif

#define TABLE_PERMUTES (PTB_SIMD && (PTB_LANES == PTB_SIMD || PTB_LANES == 2 * PTB_SIMD))

/* clang takes elements by a vector of indices in one instruction where both fill a register. (Of OpenCL's shuffle Intel's
   compiler makes bytes' permutes, PoCL's a loop.) */
#if PTB_SIMD == 16
static inline float16 table_part(const Table* table, uint16 index) {
    return __builtin_shufflevector(table->row, as_int16(index));
}
#elif PTB_SIMD == 8
static inline float8 table_part(const Table* table, uint8 index) {
    const float8 low = __builtin_shufflevector(table->row.lo, as_int8(index));
    const float8 high = __builtin_shufflevector(table->row.hi, as_int8(index));
    return select(low, high, index > 7u);
}
#endif

#if TABLE_PERMUTES && PTB_LANES == PTB_SIMD
static inline lanes_f table_lookup(const Table* table, lanes_u index) { return table_part(table, index); }
#elif TABLE_PERMUTES
static inline lanes_f table_lookup(const Table* table, lanes_u index) {
    return (lanes_f)(table_part(table, index.lo), table_part(table, index.hi));
}
#endif

#endif
