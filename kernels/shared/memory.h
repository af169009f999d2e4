// Vectors and matrices from and to arrays: the only file here that is OpenCL C alone, after symmetric.h. Columns: entry
// k of element i of n at n * k + i. Rows: at width * i + k.
static inline Vec3 row3(global const real* a, int i) { return vec3(a[3 * i], a[3 * i + 1], a[3 * i + 2]); }
static inline Symmetric row6(global const real* a, int i) {
  return symmetric(a[6 * i], a[6 * i + 1], a[6 * i + 2], a[6 * i + 3], a[6 * i + 4], a[6 * i + 5]);
}

static inline Mat3 row9(global const real* a, int i) {
  return mat3(row3(a, 3 * i), row3(a, 3 * i + 1), row3(a, 3 * i + 2));
}

static inline void store_row3(Vec3 v, global real* a, int i) {
  a[3 * i] = v.x;
  a[3 * i + 1] = v.y;
  a[3 * i + 2] = v.z;
}
static inline void store_row9(Mat3 m, global real* a, int i) {
  store_row3(m.x, a, 3 * i);
  store_row3(m.y, a, 3 * i + 1);
  store_row3(m.z, a, 3 * i + 2);
}

/// Of columns k, k + 1, k + 2; and so on.
static inline Vec3 column3(global const real* a, int n, int k, int i) {
  return vec3(a[n * k + i], a[n * (k + 1) + i], a[n * (k + 2) + i]);
}
static inline Symmetric column6(global const real* a, int n, int k, int i) {
  return symmetric(a[n * k + i], a[n * (k + 1) + i], a[n * (k + 2) + i], a[n * (k + 3) + i], a[n * (k + 4) + i],
                   a[n * (k + 5) + i]);
}
static inline Mat3 column9(global const real* a, int n, int i) {
  return mat3(column3(a, n, 0, i), column3(a, n, 3, i), column3(a, n, 6, i));
}

static inline void store_column3(Vec3 v, global real* a, int n, int k, int i) {
  a[n * k + i] = v.x;
  a[n * (k + 1) + i] = v.y;
  a[n * (k + 2) + i] = v.z;
}
static inline void store_column6(Symmetric s, global real* a, int n, int i) {
  store_column3(vec3(s.xx, s.xy, s.xz), a, n, 0, i);
  store_column3(vec3(s.yy, s.yz, s.zz), a, n, 3, i);
}
static inline void store_column9(Mat3 m, global real* a, int n, int i) {
  store_column3(m.x, a, n, 0, i);
  store_column3(m.y, a, n, 3, i);
  store_column3(m.z, a, n, 6, i);
}
