/* Lanes: one work-item traces PTB_LANES rays together (1, 4, 8 or 16). On CPUs the compiler keeps a kernel with one
   ray a work-item scalar, while explicit vectors become SIMD registers; on GPUs one lane a work-item is best.
   Everything below has the same spelling and meaning for every width. A mask is what a comparison gives; it is used
   with &, |, ! and lanes_select only. */
#ifndef PTB_LIB_LANES_H
#define PTB_LIB_LANES_H

#ifndef PTB_LANES
#define PTB_LANES 1
#endif

#if PTB_LANES == 1

typedef float lanes_f;
typedef int lanes_i;
typedef uint lanes_u;
typedef int lanes_mask;
#define LANE(value, lane) (value)
#define lanes_as_f as_float
#define lanes_as_i as_int
#define lanes_as_u as_uint
#define lanes_to_f convert_float
#define lanes_to_i convert_int
#define LANES_NUMBERS ((lanes_u)0)
static inline bool lanes_any(lanes_mask mask) { return mask != 0; }
static inline lanes_mask lanes_none(void) { return 0; }
static inline lanes_mask lanes_all(void) { return 1; }

#else

#define PTB_GLUE_(a, b) a##b
#define PTB_GLUE(a, b) PTB_GLUE_(a, b)
typedef PTB_GLUE(float, PTB_LANES) lanes_f;
typedef PTB_GLUE(int, PTB_LANES) lanes_i;
typedef PTB_GLUE(uint, PTB_LANES) lanes_u;
typedef PTB_GLUE(int, PTB_LANES) lanes_mask;
#define LANE(value, lane) ((value)[lane])
#define lanes_as_f PTB_GLUE(as_float, PTB_LANES)
#define lanes_as_i PTB_GLUE(as_int, PTB_LANES)
#define lanes_as_u PTB_GLUE(as_uint, PTB_LANES)
#define lanes_to_f PTB_GLUE(convert_float, PTB_LANES)
#define lanes_to_i PTB_GLUE(convert_int, PTB_LANES)
static inline bool lanes_any(lanes_mask mask) { return any(mask); }
static inline lanes_mask lanes_none(void) { return (lanes_mask)(0); }
static inline lanes_mask lanes_all(void) { return (lanes_mask)(-1); }

#endif

/* if_true where the mask is set, if_false elsewhere. */
static inline lanes_f lanes_select(lanes_f if_false, lanes_f if_true, lanes_mask mask) {
    return select(if_false, if_true, mask);
}
static inline lanes_u lanes_select_u(lanes_u if_false, lanes_u if_true, lanes_mask mask) {
    return select(if_false, if_true, mask);
}

#endif
