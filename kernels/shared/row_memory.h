// Rows from and to arrays, in OpenCL C alone, after rows.h. Arrays of the host's numbers hold
// `host_scalar`. Nothing beyond a matrix is read, where another item may write.
static inline Rows load_host_rows(global const host_scalar* a) {
  return rows(to_scalar4(vload4(0, a)), to_scalar4(vload4(0, a + 3)), to_scalar4(vload4(0, a + 5).yzwx));
}

/// Of a symmetric matrix's xx, xy, xz, yy, yz, zz, and two more numbers.
static inline Rows load_symmetric_rows(global const real* a) {
  const Row low = vload4(0, a), high = vload4(0, a + 4);
  return rows(low, (Row)(low.y, low.w, high.x, 0), (Row)(low.z, high.xy, 0));
}

static inline void store_host_rows(Rows r, global host_scalar* a) {
  vstore4(to_host4(r.x), 0, a);
  vstore4(to_host4(r.y), 0, a + 3);
  vstore3(to_host4(r.z).xyz, 0, a + 6);
}
