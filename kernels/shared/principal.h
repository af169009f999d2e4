// Eigenvalues and eigenvectors of a symmetric matrix by Jacobi's rotations, in C99 ∩ C++, after symmetric.h.
typedef struct {
  Symmetric rest;   // What is left of the matrix: diagonal in the end.
  Mat3 directions;  // Rows: where its axes point.
} Principal;

/// The axes x, y, z as y, z, x.
static inline Principal next_axes(Principal p) {
  const Symmetric a = p.rest;
  p.rest = symmetric(a.yy, a.yz, a.xy, a.zz, a.xz, a.xx);
  p.directions = mat3(p.directions.y, p.directions.z, p.directions.x);
  return p;
}

/// Turns x and y so that xy vanishes. `least` is nothing beside the matrix.
static inline Principal without_xy(Principal p, real least) {
  const Symmetric a = p.rest;
  const real d = a.yy - a.xx, size = fabs(d) + sqrt(d * d + (real)4 * a.xy * a.xy) + least;
  const real tangent = (real)2 * a.xy / (d < (real)0 ? -size : size);
  const real c = (real)1 / sqrt((real)1 + tangent * tangent), s = tangent * c;
  p.rest =
      symmetric(a.xx - tangent * a.xy, (real)0, c * a.xz - s * a.yz, a.yy + tangent * a.xy, s * a.xz + c * a.yz, a.zz);
  const Vec3 x = p.directions.x, y = p.directions.y;
  p.directions.x = sub3(scale3(c, x), scale3(s, y));
  p.directions.y = add3(scale3(s, x), scale3(c, y));
  return p;
}

/// With x and y in order.
static inline Principal ascending_xy(Principal p) {
  const mask swapped = p.rest.yy < p.rest.xx;
  const Vec3 x = p.directions.x, y = p.directions.y;
  const real xx = p.rest.xx, yy = p.rest.yy;
  p.rest.xx = swapped ? yy : xx;
  p.rest.yy = swapped ? xx : yy;
  p.directions.x = choose3(swapped, y, x);
  p.directions.y = choose3(swapped, x, y);
  return p;
}

/// Ascending. The sizes of the entries sum to about 1, or all are 0. Seven rounds leave nothing beside the rounding of
/// doubles: each squares what is left.
static inline Principal principal(Symmetric a) {
  Principal p;
  p.rest = a;
  p.directions =
      mat3(vec3((real)1, (real)0, (real)0), vec3((real)0, (real)1, (real)0), vec3((real)0, (real)0, (real)1));
  for (int k = 0; k < 21; ++k) p = next_axes(without_xy(p, (real)1e-30));
  // Where the other two are in order, the third goes to its place.
  p = ascending_xy(p);
  p = next_axes(next_axes(ascending_xy(next_axes(p))));
  return ascending_xy(p);
}
