// How far scaling takes a triangle off its surface, in C99 ∩ C++, after vec3.h.

/// The unit normal of a triangle by two of its sides one after the other; 0 where its height is below `least` of its
/// longest side.
static inline Vec3 certain_normal(Vec3 first, Vec3 second, real least) {
  const Vec3 third = add3(first, second);
  const real a = dot3(first, first), b = dot3(second, second), c = dot3(third, third);
  const real longest = sqrt(a > b ? (a > c ? a : c) : (b > c ? b : c));
  // Divided first: squares of small areas would underflow.
  const real per_length = longest > (real)0 ? (real)1 / longest : (real)0;
  const Vec3 area = cross3(scale3(per_length, first), scale3(per_length, second));
  const real size = sqrt(dot3(area, area));
  return scale3(size > least ? (real)1 / size : (real)0, area);
}

/// A weighted sum of |n · u| for each axis u, and of the weights.
typedef struct {
  Vec3 sum;
  real weight;
} Slippage;

static inline Slippage no_slippage(void) {
  Slippage s;
  s.sum = vec3((real)0, (real)0, (real)0);
  s.weight = (real)0;
  return s;
}

static inline Slippage add_normal(Slippage s, real weight, Vec3 normal) {
  s.sum = add3(s.sum, scale3(weight, vec3(fabs(normal.x), fabs(normal.y), fabs(normal.z))));
  s.weight += weight;
  return s;
}

static inline Vec3 mean_slippage(Slippage s) {
  return scale3(s.weight > (real)0 ? (real)1 / s.weight : (real)0, s.sum);
}
