// Lanes from and to arrays, in OpenCL C alone, after lanes.h and mat3.h. Item i has elements LANES i and those after.
// Columns: entry k of element e at stride * k + e; the stride is a multiple of LANES, so that the last item's elements
// beyond the count have room. Tiles: the same for GROUP elements after GROUP elements, so that what an item needs lies
// close. Rows: at width * e + k. Arrays of the host's numbers hold `host_scalar`.
#ifndef ALWAYS_INLINE
#define ALWAYS_INLINE __attribute__((always_inline))
#endif
#define INLINE static inline ALWAYS_INLINE

// What names each lane.
#if LANES == 1
#define VLOAD(i, a) (a)[i]
#define VSTORE(v, i, a) (a)[i] = v
#define LANE_NUMBERS 0
#define GATHER(a, at) (a)[at]
#define SCATTER(v, a, step) (a)[0 * (step)] = v
#elif LANES == 8
#define VLOAD(i, a) vload8((size_t)(i), a)
#define VSTORE(v, i, a) vstore8(v, (size_t)(i), a)
#define LANE_NUMBERS (int8)(0, 1, 2, 3, 4, 5, 6, 7)
#define GATHER(a, at) ((a)[at.s0], (a)[at.s1], (a)[at.s2], (a)[at.s3], (a)[at.s4], (a)[at.s5], (a)[at.s6], (a)[at.s7])
#define SCATTER(v, a, step)                                                                          \
  (a)[0] = v.s0, (a)[step] = v.s1, (a)[2 * step] = v.s2, (a)[3 * step] = v.s3, (a)[4 * step] = v.s4, \
  (a)[5 * step] = v.s5, (a)[6 * step] = v.s6, (a)[7 * step] = v.s7
#else
#define VLOAD(i, a) vload16((size_t)(i), a)
#define VSTORE(v, i, a) vstore16(v, (size_t)(i), a)
#define LANE_NUMBERS (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define GATHER(a, at)                                                                                          \
  ((a)[at.s0], (a)[at.s1], (a)[at.s2], (a)[at.s3], (a)[at.s4], (a)[at.s5], (a)[at.s6], (a)[at.s7], (a)[at.s8], \
   (a)[at.s9], (a)[at.sa], (a)[at.sb], (a)[at.sc], (a)[at.sd], (a)[at.se], (a)[at.sf])
#define SCATTER(v, a, step)                                                                                          \
  (a)[0] = v.s0, (a)[step] = v.s1, (a)[2 * step] = v.s2, (a)[3 * step] = v.s3, (a)[4 * step] = v.s4,                 \
  (a)[5 * step] = v.s5, (a)[6 * step] = v.s6, (a)[7 * step] = v.s7, (a)[8 * step] = v.s8, (a)[9 * step] = v.s9,      \
  (a)[10 * step] = v.sa, (a)[11 * step] = v.sb, (a)[12 * step] = v.sc, (a)[13 * step] = v.sd, (a)[14 * step] = v.se, \
  (a)[15 * step] = v.sf
#endif

INLINE real load_lanes(global const scalar* a, int i) { return VLOAD(i, a); }
INLINE void store_lanes(real v, global scalar* a, int i) { VSTORE(v, i, a); }
INLINE Vec3 load_lanes3(global const scalar* a, int stride, int k, int i) {
  return vec3(load_lanes(a + stride * k, i), load_lanes(a + stride * (k + 1), i), load_lanes(a + stride * (k + 2), i));
}
INLINE Mat3 load_lanes9(global const scalar* a, int stride, int i) {
  return mat3(load_lanes3(a, stride, 0, i), load_lanes3(a, stride, 3, i), load_lanes3(a, stride, 6, i));
}
INLINE void store_lanes3(Vec3 v, global scalar* a, int stride, int k, int i) {
  store_lanes(v.x, a + stride * k, i);
  store_lanes(v.y, a + stride * (k + 1), i);
  store_lanes(v.z, a + stride * (k + 2), i);
}
INLINE void store_lanes9(Mat3 m, global scalar* a, int stride, int i) {
  store_lanes3(m.x, a, stride, 0, i);
  store_lanes3(m.y, a, stride, 3, i);
  store_lanes3(m.z, a, stride, 6, i);
}

/// Entry k of elements of `width` entries each, in tiles; and k, k + 1, k + 2.
INLINE int tile_place(int width, int k, int i) {
  const int items = GROUP / LANES;
  return (i / items * width + k) * items + i % items;
}
INLINE lane_index load_indices(global const int* a, int width, int k, int i) {
  return VLOAD(tile_place(width, k, i), a);
}
INLINE real load_tile(global const scalar* a, int width, int k, int i) {
  return load_lanes(a, tile_place(width, k, i));
}
INLINE void store_tile(real v, global scalar* a, int width, int k, int i) {
  store_lanes(v, a, tile_place(width, k, i));
}
INLINE Vec3 load_tile3(global const scalar* a, int width, int k, int i) {
  return vec3(load_tile(a, width, k, i), load_tile(a, width, k + 1, i), load_tile(a, width, k + 2, i));
}

/// An item's own elements; the last again for those beyond the count.
INLINE lane_index own_elements(int i, int count) { return min(LANES * i + LANE_NUMBERS, (lane_index)(count - 1)); }
/// How many of an item's elements there are.
INLINE int elements_of(int i, int count) { return min(LANES, count - LANES * i); }

/// 1 where the condition holds, else 0.
INLINE real one_where(lane_index condition) { return to_lanes(condition ? (lane_index)1 : (lane_index)0); }
INLINE real present_lanes(int i, int count) { return one_where(LANES * i + LANE_NUMBERS < (lane_index)count); }

/// Entries at given places.
INLINE real gather(global const scalar* a, lane_index at) { return (real)GATHER(a, at); }
INLINE wide gather_exactly(global const host_scalar* a, lane_index at) { return (wide)GATHER(a, at); }
INLINE real gather_host(global const host_scalar* a, lane_index at) { return to_lanes(gather_exactly(a, at)); }

/// Rows of given elements.
INLINE Vec3 gather3(global const scalar* a, lane_index at) {
  return vec3(gather(a, 3 * at), gather(a + 1, 3 * at), gather(a + 2, 3 * at));
}
INLINE Vec3 gather_host3(global const host_scalar* a, lane_index at) {
  return vec3(gather_host(a, 3 * at), gather_host(a + 1, 3 * at), gather_host(a + 2, 3 * at));
}

/// An entry each to the rows of an item's elements, the first at `a`. There is room for whole items.
INLINE void store_entries(real v, global scalar* a, int width) { SCATTER(v, a, width); }

/// The same to arrays of the host's, where there are so many elements and no room for more.
INLINE void store_wide_entries(wide v, global host_scalar* a, int width, int elements) {
  if (elements == LANES) {
    SCATTER(v, a, width);
  } else {
    host_scalar entries[LANES];
    SCATTER(v, entries, 1);
    for (int k = 0; k < elements; ++k) a[width * k] = entries[k];
  }
}
INLINE void store_host_entries(real v, global host_scalar* a, int width, int elements) {
  store_wide_entries(to_wide(v), a, width, elements);
}
