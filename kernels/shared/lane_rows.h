// Rows of elements, from and to lanes, four entries at a time, in OpenCL C alone, after lane_memory.h. Eight lanes are
// filled from pieces of rows and turned by shuffles, in a third of the instructions of one number after the other.

/// Four neighbouring entries of each lane's row.
typedef struct {
  real x, y, z, w;
} Four;

INLINE Four four(real x, real y, real z, real w) {
  Four f;
  f.x = x, f.y = y, f.z = z, f.w = w;
  return f;
}

#if LANES == 8
#define LOW_PAIRS(p, q) (real)(p.s0, q.s0, p.s1, q.s1, p.s4, q.s4, p.s5, q.s5)
#define HIGH_PAIRS(p, q) (real)(p.s2, q.s2, p.s3, q.s3, p.s6, q.s6, p.s7, q.s7)
#define LOW_HALVES(p, q) (real)(p.s01, q.s01, p.s45, q.s45)
#define HIGH_HALVES(p, q) (real)(p.s23, q.s23, p.s67, q.s67)

/// The 4 × 4 matrices of lanes 0 to 3 and 4 to 7, transposed: columns from rows k and k + 4 side by side, k = 0 .. 3,
/// or such rows from columns.
INLINE Four turned(Four f) {
  const real low = LOW_PAIRS(f.x, f.y), high = HIGH_PAIRS(f.x, f.y);
  const real next_low = LOW_PAIRS(f.z, f.w), next_high = HIGH_PAIRS(f.z, f.w);
  return four(LOW_HALVES(low, next_low), HIGH_HALVES(low, next_low), LOW_HALVES(high, next_high),
              HIGH_HALVES(high, next_high));
}

#define SAME(v) v
#define GATHER4(as, a, at)                                                \
  turned(four((real)(as(vload4(0, a + at.s0)), as(vload4(0, a + at.s4))), \
              (real)(as(vload4(0, a + at.s1)), as(vload4(0, a + at.s5))), \
              (real)(as(vload4(0, a + at.s2)), as(vload4(0, a + at.s6))), \
              (real)(as(vload4(0, a + at.s3)), as(vload4(0, a + at.s7)))))
#define SCATTER4(as, rows, a, step)                                                 \
  vstore4(as(rows.x.lo), 0, a), vstore4(as(rows.y.lo), 0, a + step);                \
  vstore4(as(rows.z.lo), 0, a + 2 * step), vstore4(as(rows.w.lo), 0, a + 3 * step); \
  vstore4(as(rows.x.hi), 0, a + 4 * step), vstore4(as(rows.y.hi), 0, a + 5 * step); \
  vstore4(as(rows.z.hi), 0, a + 6 * step), vstore4(as(rows.w.hi), 0, a + 7 * step)

INLINE Four gather4(global const scalar* a, lane_index at) { return GATHER4(SAME, a, at); }
INLINE Four gather_host4(global const host_scalar* a, lane_index at) { return GATHER4(to_scalar4, a, at); }
INLINE void scatter4(Four f, global scalar* a, int step) {
  const Four rows = turned(f);
  SCATTER4(SAME, rows, a, step);
}
INLINE void scatter_host4(Four f, global host_scalar* a, int step) {
  const Four rows = turned(f);
  SCATTER4(to_host4, rows, a, step);
}
#else
INLINE Four gather4(global const scalar* a, lane_index at) {
  return four(gather(a, at), gather(a + 1, at), gather(a + 2, at), gather(a + 3, at));
}
INLINE Four gather_host4(global const host_scalar* a, lane_index at) {
  return four(gather_host(a, at), gather_host(a + 1, at), gather_host(a + 2, at), gather_host(a + 3, at));
}
INLINE void scatter4(Four f, global scalar* a, int step) {
  store_entries(f.x, a, step), store_entries(f.y, a + 1, step);
  store_entries(f.z, a + 2, step), store_entries(f.w, a + 3, step);
}
INLINE void scatter_host4(Four f, global host_scalar* a, int step) {
  const wide x = to_wide(f.x), y = to_wide(f.y), z = to_wide(f.z), w = to_wide(f.w);
  SCATTER(x, a, step), SCATTER(y, a + 1, step), SCATTER(z, a + 2, step), SCATTER(w, a + 3, step);
}
#endif

INLINE Mat3 mat3_of_fours(Four first, Four second, real last) {
  return mat3(vec3(first.x, first.y, first.z), vec3(first.w, second.x, second.y), vec3(second.z, second.w, last));
}

/// A matrix each from rows of the host's, of given elements.
INLINE Mat3 gather_host9(global const host_scalar* a, lane_index at) {
  return mat3_of_fours(gather_host4(a, 9 * at), gather_host4(a + 4, 9 * at), gather_host(a + 8, 9 * at));
}

/// Four entries each to rows of the host's, as store_host_entries does one.
INLINE void store_host4(Four f, global host_scalar* a, int width, int elements) {
  if (elements == LANES) {
    scatter_host4(f, a, width);
  } else {
    store_host_entries(f.x, a, width, elements);
    store_host_entries(f.y, a + 1, width, elements);
    store_host_entries(f.z, a + 2, width, elements);
    store_host_entries(f.w, a + 3, width, elements);
  }
}

/// Whole rows of item i's elements.
INLINE void store_host_rows9(Mat3 m, global host_scalar* a, int i, int count) {
  const int elements = elements_of(i, count);
  a += 9 * LANES * i;
  store_host4(four(m.x.x, m.x.y, m.x.z, m.y.x), a, 9, elements);
  store_host4(four(m.y.y, m.y.z, m.z.x, m.z.y), a + 4, 9, elements);
  store_host_entries(m.z.z, a + 8, 9, elements);
}
