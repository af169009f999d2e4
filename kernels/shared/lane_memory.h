// Lanes from and to arrays, in OpenCL C alone, after lanes.h and mat3.h. Columns: entry k of element i at stride * k +
// i; the stride is a multiple of LANES, so that the last item's elements beyond the count have room.
static inline real load_lanes(global const scalar* a, int i) {
#if LANES == 1
  return a[i];
#else
  return vload16((size_t)i, a);
#endif
}
static inline void store_lanes(real v, global scalar* a, int i) {
#if LANES == 1
  a[i] = v;
#else
  vstore16(v, (size_t)i, a);
#endif
}

static inline Vec3 load_lanes3(global const scalar* a, int stride, int k, int i) {
  return vec3(load_lanes(a + stride * k, i), load_lanes(a + stride * (k + 1), i), load_lanes(a + stride * (k + 2), i));
}
static inline Mat3 load_lanes9(global const scalar* a, int stride, int i) {
  return mat3(load_lanes3(a, stride, 0, i), load_lanes3(a, stride, 3, i), load_lanes3(a, stride, 6, i));
}
static inline void store_lanes3(Vec3 v, global scalar* a, int stride, int k, int i) {
  store_lanes(v.x, a + stride * k, i);
  store_lanes(v.y, a + stride * (k + 1), i);
  store_lanes(v.z, a + stride * (k + 2), i);
}
static inline void store_lanes9(Mat3 m, global scalar* a, int stride, int i) {
  store_lanes3(m.x, a, stride, 0, i);
  store_lanes3(m.y, a, stride, 3, i);
  store_lanes3(m.z, a, stride, 6, i);
}
