/* Tables of 16 floats that every lane reads at its own index (0 to 15): one or two register permutes where the
   instruction set has them, a load per lane elsewhere. */
#ifndef PTB_LIB_TABLE_H
#define PTB_LIB_TABLE_H

#include "lib/lanes.h"

#define TABLE_ROWS 16

typedef struct Table {
    float16 row;
} Table;

/* PTB_PORTABLE switches every use of a machine's own instructions off, to measure what they are worth. */
#if !defined(PTB_PORTABLE) && defined(__has_builtin)
#if PTB_LANES == 16 && defined(__AVX512F__) && __has_builtin(__builtin_ia32_permvarsf512)
#define TABLE_PERMUTES 512
#elif PTB_LANES == 8 && defined(__AVX2__) && __has_builtin(__builtin_ia32_permvarsf256)
#define TABLE_PERMUTES 256
#endif
#endif
#ifndef TABLE_PERMUTES
#define TABLE_PERMUTES 0
#endif

/* The member of each lane's own row of an array of structs. */
#if PTB_LANES == 1
#define LANES_GATHER(rows, index, member) ((rows)[index].member)
#elif PTB_LANES == 4
#define LANES_GATHER(rows, index, member)                                                        \
    ((float4)((rows)[(index).s0].member, (rows)[(index).s1].member, (rows)[(index).s2].member, \
              (rows)[(index).s3].member))
#elif PTB_LANES == 8
#define LANES_GATHER(rows, index, member)                                                        \
    ((float8)((rows)[(index).s0].member, (rows)[(index).s1].member, (rows)[(index).s2].member, \
              (rows)[(index).s3].member, (rows)[(index).s4].member, (rows)[(index).s5].member, \
              (rows)[(index).s6].member, (rows)[(index).s7].member))
#elif PTB_LANES == 16
#define LANES_GATHER(rows, index, member)                                                          \
    ((float16)((rows)[(index).s0].member, (rows)[(index).s1].member, (rows)[(index).s2].member,  \
               (rows)[(index).s3].member, (rows)[(index).s4].member, (rows)[(index).s5].member,  \
               (rows)[(index).s6].member, (rows)[(index).s7].member, (rows)[(index).s8].member,  \
               (rows)[(index).s9].member, (rows)[(index).sa].member, (rows)[(index).sb].member,  \
               (rows)[(index).sc].member, (rows)[(index).sd].member, (rows)[(index).se].member,  \
               (rows)[(index).sf].member))
#endif

#if TABLE_PERMUTES == 512

static inline lanes_f table_lookup(const Table* table, lanes_u index) {
    return __builtin_ia32_permvarsf512(table->row, as_int16(index));
}

#elif TABLE_PERMUTES == 256

static inline lanes_f table_lookup(const Table* table, lanes_u index) {
    const float8 low = __builtin_ia32_permvarsf256(table->row.lo, as_int8(index));
    const float8 high = __builtin_ia32_permvarsf256(table->row.hi, as_int8(index));
    return select(low, high, index > 7u);
}

#endif

#endif
