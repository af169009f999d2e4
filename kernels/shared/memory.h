// Vectors and matrices from and to arrays, an item an element, in OpenCL C alone, after mat3.h. Columns: entry k of
// element i of n at n * k + i. Rows: at width * i + k. Arrays of the host's numbers hold `host_scalar`.
static inline Vec3 host_row3(global const host_scalar* a, int i) {
  return vec3((real)a[3 * i], (real)a[3 * i + 1], (real)a[3 * i + 2]);
}
static inline Mat3 host_row9(global const host_scalar* a, int i) {
  return mat3(host_row3(a, 3 * i), host_row3(a, 3 * i + 1), host_row3(a, 3 * i + 2));
}

static inline void store_host_row3(Vec3 v, global host_scalar* a, int i) {
  a[3 * i] = (host_scalar)v.x;
  a[3 * i + 1] = (host_scalar)v.y;
  a[3 * i + 2] = (host_scalar)v.z;
}
static inline void store_host_row9(Mat3 m, global host_scalar* a, int i) {
  store_host_row3(m.x, a, 3 * i);
  store_host_row3(m.y, a, 3 * i + 1);
  store_host_row3(m.z, a, 3 * i + 2);
}

/// Of columns k, k + 1, k + 2.
static inline Vec3 column3(global const real* a, int n, int k, int i) {
  return vec3(a[n * k + i], a[n * (k + 1) + i], a[n * (k + 2) + i]);
}
