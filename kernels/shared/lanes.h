// `real` as LANES scalars side by side, an element each: an item that many elements. So kernels of long formulas keep a
// processor's vector unit at work, whatever its compiler makes of them.
typedef lanes real;
typedef lane_mask mask;

#if LANES == 1
static inline int any_lane(mask condition) { return condition; }
#else
static inline int any_lane(mask condition) { return any(condition); }
#endif
