// What rotation and similarity fit: for each element sum_p b_p (w_p a_p)ᵀ over its pairs, and t (w_n n)ᵀ of its normal.
// In OpenCL C alone, after lane_memory.h.

/// The entries of one element's sum, LANES apart. `edges`: w_p a_p, a row a pair.
INLINE void sum_pairs(int first, int last, global const int* pairs, global const scalar* edges,
                      global const host_scalar* positions, const host_scalar per_length, scalar* sum) {
  scalar4 x = 0, y = 0, z = 0;
  for (int p = first; p < last; ++p) {
    const host_scalar4 from = (host_scalar4)(vload3((size_t)pairs[2 * p], positions), 0),
                       to = (host_scalar4)(vload3((size_t)pairs[2 * p + 1], positions), 0);
    const scalar4 b = to_scalar4(per_length * (to - from)), a = (scalar4)(vload3((size_t)p, edges), 0);
    x += b.x * a;
    y += b.y * a;
    z += b.z * a;
  }
  sum[0] = x.x, sum[LANES] = x.y, sum[2 * LANES] = x.z;
  sum[3 * LANES] = y.x, sum[4 * LANES] = y.y, sum[5 * LANES] = y.z;
  sum[6 * LANES] = z.x, sum[7 * LANES] = z.y, sum[8 * LANES] = z.z;
}

/// Of item i's elements.
INLINE Mat3 pair_sums(int i, int count, global const int* offsets, global const int* pairs, global const scalar* edges,
                      global const host_scalar* positions, const host_scalar per_length) {
  scalar s[9 * LANES];
  for (int k = 0; k < LANES; ++k) {
    const int e = min(LANES * i + k, count - 1);
    sum_pairs(offsets[e], offsets[e + 1], pairs, edges, positions, per_length, s + k);
  }
  return mat3(vec3(VLOAD(0, s), VLOAD(1, s), VLOAD(2, s)), vec3(VLOAD(3, s), VLOAD(4, s), VLOAD(5, s)),
              vec3(VLOAD(6, s), VLOAD(7, s), VLOAD(8, s)));
}

/// `normals`: w_n n, in rows like the targets.
INLINE Mat3 normal_terms(int i, int count, global const scalar* normals, global const host_scalar* targets) {
  const lane_index own = own_elements(i, count);
  return outer3(gather_host3(targets, own), gather3(normals, own));
}
