// Rows from and to arrays, in OpenCL C alone, after rows.h.
static inline Rows load_rows(global const real* a) {
  // Not from a + 6: nothing beyond a matrix is read, where another item may write.
  return rows(vload4(0, a), vload4(0, a + 3), vload4(0, a + 5).yzwx);
}

/// Of a symmetric matrix's xx, xy, xz, yy, yz, zz, and two more numbers.
static inline Rows load_symmetric_rows(global const real* a) {
  const Row low = vload4(0, a), high = vload4(0, a + 4);
  return rows(low, (Row)(low.y, low.w, high.x, 0), (Row)(low.z, high.xy, 0));
}

static inline void store_rows(Rows r, global real* a) {
  vstore4(r.x, 0, a);
  vstore4(r.y, 0, a + 3);
  vstore3(r.z.xyz, 0, a + 6);
}
