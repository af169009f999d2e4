// Sums over an item's elements, in OpenCL C alone, after lanes.h.
static inline scalar sum_lanes(real v) {
#if LANES == 1
  return v;
#elif LANES == 8
  const scalar4 s = v.lo + v.hi;
  return s.x + s.y + s.z + s.w;
#else
  const scalar4 s = v.s0123 + v.s4567 + v.s89ab + v.scdef;
  return s.x + s.y + s.z + s.w;
#endif
}

/// Three sums over an item's elements.
static inline void store_sums(int i, global scalar* sums, real a, real b, real c) {
  vstore4((scalar4)(sum_lanes(a), sum_lanes(b), sum_lanes(c), 0), (size_t)i, sums);
}
