// Sides of triangles from positions, in OpenCL C alone, after triangle.h and lane_memory.h. `residues` are what
// rounding took from positions that are not the host's own: differences of near positions stay exact.

/// Along one axis, from vertex a to b, b to c and c to a.
INLINE Vec3 gaps_between(global const host_scalar* positions, global const scalar* residues, lane_index a, lane_index b,
                         lane_index c) {
  const wide at_a = gather_exactly(positions, a), at_b = gather_exactly(positions, b);
  const wide at_c = gather_exactly(positions, c);
  const Vec3 gaps = vec3(to_lanes(at_b - at_a), to_lanes(at_c - at_b), to_lanes(at_a - at_c));
  if (HOST_IS_EXACT) return gaps;
  const real of_a = gather(residues, a), of_b = gather(residues, b), of_c = gather(residues, c);
  return add3(gaps, vec3(of_b - of_a, of_c - of_b, of_a - of_c));
}

INLINE Sides sides_between(global const host_scalar* positions, global const scalar* residues, lane_index a,
                           lane_index b, lane_index c) {
  const Vec3 x = gaps_between(positions, residues, 3 * a, 3 * b, 3 * c);
  const Vec3 y = gaps_between(positions + 1, residues + 1, 3 * a, 3 * b, 3 * c);
  const Vec3 z = gaps_between(positions + 2, residues + 2, 3 * a, 3 * b, 3 * c);
  return sides(vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y), vec3(x.z, y.z, z.z));
}
