// The nearest of unit vectors, in C99 ∩ C++, after principal.h.

static inline real not_below(real a, real least) { return a < least ? least : a; }

/// The unit vector n that makes nᵀ H n - 2 b . n the least, of an H that is not negative: (H + t) n = b with t above
/// minus the least eigenvalue. Newton's steps for 1 / |n| = 1, which is concave in t, come from below: ten leave
/// nothing beside the rounding of doubles. The sizes of H and b sum to about 1, or all are 0.
static inline Vec3 nearest_unit(Symmetric h, Vec3 b) {
  const Principal p = principal(h);
  const Vec3 c = apply3(p.directions, b);
  real t = not_below(not_below(fabs(c.x) - p.rest.xx, fabs(c.y) - p.rest.yy), fabs(c.z) - p.rest.zz);
  t = not_below(t, (real)1e-7 - p.rest.xx);
  Vec3 n = vec3((real)0, (real)0, (real)0);
  for (int k = 0; k < 10; ++k) {
    const real x = (real)1 / (p.rest.xx + t), y = (real)1 / (p.rest.yy + t), z = (real)1 / (p.rest.zz + t);
    n = vec3(x * c.x, y * c.y, z * c.z);
    const real square = dot3(n, n), slope = x * n.x * n.x + y * n.y * n.y + z * n.z * n.z;
    t += square * not_below(sqrt(square) - (real)1, (real)0) / (slope + (real)1e-30);
  }
  const real length = sqrt(dot3(n, n)) + (real)1e-30;
  return apply3(transpose3(p.directions), scale3((real)1 / length, n));
}
