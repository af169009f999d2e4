// A triangle's corners as the sphericity term compares them (reshape paper, eqs. 17 and 18), in C99 ∩ C++, after
// mat3.h. Side i runs from corner i to the next; corner i turns by i's cosine and sine about the axis, which takes the
// direction against side i - 1 into that of side i.
typedef struct {
  Vec3 axis, cosines, sines;
} Corners;

/// One vector for each side.
typedef struct {
  Vec3 first, second, third;
} Sides;

static inline Sides sides(Vec3 first, Vec3 second, Vec3 third) {
  Sides s;
  s.first = first;
  s.second = second;
  s.third = third;
  return s;
}
static inline Sides map_sides(Mat3 transform, Sides s) {
  return sides(apply3(transform, s.first), apply3(transform, s.second), apply3(transform, s.third));
}

/// Rodrigues.
static inline Vec3 turned3(Vec3 axis, real cosine, real sine, Vec3 v) {
  const Vec3 along = scale3(((real)1 - cosine) * dot3(axis, v), axis);
  return add3(add3(scale3(cosine, v), scale3(sine, cross3(axis, v))), along);
}

/// For each corner the miss between its two sides, each in parts of its rest length.
static inline Sides corner_misses(Corners corners, Sides s) {
  const Vec3 c = corners.cosines, n = corners.sines;
  return sides(add3(s.first, turned3(corners.axis, c.x, n.x, s.third)),
               add3(s.second, turned3(corners.axis, c.y, n.y, s.first)),
               add3(s.third, turned3(corners.axis, c.z, n.z, s.second)));
}

static inline real sum_of_squares(Sides s) {
  return dot3(s.first, s.first) + dot3(s.second, s.second) + dot3(s.third, s.third);
}

/// Half the gradient of sum_of_squares(corner_misses(corners, map_sides(transform, rest))) by the transform.
static inline Mat3 corner_pull(Corners corners, Mat3 transform, Sides rest) {
  const Sides misses = corner_misses(corners, map_sides(transform, rest));
  const Vec3 c = corners.cosines, n = corners.sines;
  const Vec3 first = add3(misses.first, turned3(corners.axis, c.y, -n.y, misses.second));
  const Vec3 second = add3(misses.second, turned3(corners.axis, c.z, -n.z, misses.third));
  const Vec3 third = add3(misses.third, turned3(corners.axis, c.x, -n.x, misses.first));
  return add_mat3(add_mat3(outer3(first, rest.first), outer3(second, rest.second)), outer3(third, rest.third));
}
