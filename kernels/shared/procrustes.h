// The rotation R closest to a matrix M: it maximises tr Rᵀ M. In C99 ∩ C++, after vec3.h, mat3.h and symmetric.h. No
// loops and no branches: every matrix takes the same way, a lane of a vector unit each.
//
// In the unit quaternion q of R the trace is qᵀ K q with Davenport's symmetric, traceless K, so q is the eigenvector of
// K's largest eigenvalue (Horn 1987). Where two or three largest eigenvalues nearly meet, that vector drowns in
// rounding error; they do where M reflects (near to double in the two smaller singular values) or has rank one. So:
//  1. A reflection is turned into a rotation of its negative, N = ±M, det N >= 0. That leaves rank one.
//  2. Horn for N: the eigenvalue by a step of Laguerre's on K's quartic, the vector as a column of the adjugate.
//  3. Two ascents: N is turned back by the rotation found, so that the identity is nearly best, and the best is taken
//     of all quaternions in the plane of the identity and an axis: first the axis that matters near rank one, then
//     Newton's direction. No ascent loses.
//  4. For a reflection N = R P with P symmetric, nearly, and the best for M is R's half turn about P's least direction.
// The trace misses the best by less than 1e-6 |M| in single and 1e-11 |M| in double precision; by up to 1e-8 |M| in the
// latter near rank one.
//
// How sums and comparisons are written matters: LLVM pairs those that resemble each other (sums of like sums, maxima
// of a and b alike) before PoCL comes to vectorise over the items, which then fails, at 8 times the cost.

typedef struct {
  real w, x, y, z;
} Quaternion;

static inline Quaternion quaternion(real w, real x, real y, real z) {
  Quaternion q;
  q.w = w;
  q.x = x;
  q.y = y;
  q.z = z;
  return q;
}

/// [s vᵀ; v B]
typedef struct {
  real s;
  Vec3 v;
  Symmetric B;
} Davenport;

/// A direction in a plane.
typedef struct {
  real x, y;
} Heading;

/// The larger of a and 0, and of a and b but for rounding: by arithmetic, see above.
static inline real positive(real a) { return (real)0.5 * (a + fabs(a)); }
static inline real larger(real a, real b) { return a + positive(b - a); }

static inline real sum_of_sizes(Vec3 a) { return fabs(a.x) + fabs(a.y) + fabs(a.z); }
static inline Vec3 choose3(int first, Vec3 a, Vec3 b) {
  return vec3(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}
static inline Quaternion choose4(int first, Quaternion a, Quaternion b) {
  return quaternion(first ? a.w : b.w, first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

/// Its length 1; x where v is 0.
static inline Vec3 unit3(Vec3 v) {
  const real n = dot3(v, v);
  const int any = n > (real)1e-35;
  const real s = (real)1 / sqrt(any ? n : (real)1);
  return vec3(any ? s * v.x : (real)1, any ? s * v.y : (real)0, any ? s * v.z : (real)0);
}

/// Its length 1; the identity where q is 0.
static inline Quaternion unit4(Quaternion q) {
  const real n = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  const int any = n > (real)1e-35;
  const real s = (real)1 / sqrt(any ? n : (real)1);
  return quaternion(any ? s * q.w : (real)1, any ? s * q.x : (real)0, any ? s * q.y : (real)0, any ? s * q.z : (real)0);
}

static inline Quaternion multiply4(Quaternion a, Quaternion b) {
  return quaternion(a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                    a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w);
}

/// Of a unit quaternion.
static inline Mat3 rotation_of(Quaternion q) {
  const real x = q.x + q.x, y = q.y + q.y, z = q.z + q.z;
  const real wx = q.w * x, wy = q.w * y, wz = q.w * z, xx = q.x * x, xy = q.x * y, xz = q.x * z;
  const real yy = q.y * y, yz = q.y * z, zz = q.z * z;
  return mat3(vec3((real)1 - (yy + zz), xy - wz, xz + wy), vec3(xy + wz, (real)1 - (xx + zz), yz - wx),
              vec3(xz - wy, yz + wx, (real)1 - (xx + yy)));
}

static inline Davenport davenport(Mat3 m) {
  Davenport k;
  k.s = m.x.x + m.y.y + m.z.z;
  k.v = vec3(m.z.y - m.y.z, m.x.z - m.z.x, m.y.x - m.x.y);
  k.B = symmetric(m.x.x - m.y.y - m.z.z, m.x.y + m.y.x, m.x.z + m.z.x, m.y.y - m.z.z - m.x.x, m.y.z + m.z.y,
                  m.z.z - m.x.x - m.y.y);
  return k;
}

/// K as it looks from q.
static inline Davenport davenport_from(Quaternion q, Mat3 m) { return davenport(transpose_times(rotation_of(q), m)); }

/// Of the eigenvector of [a o; o b] that has the larger eigenvalue; x where either will do.
static inline Heading larger_heading(real a, real o, real b) {
  const real h = (real)0.5 * (a - b);
  const real r = sqrt(h * h + o * o);
  const int near_x = h >= (real)0;
  Heading heading;
  heading.x = near_x ? r + h + (real)1e-12 : o;
  heading.y = near_x ? o : r - h;
  return heading;
}

/// adj(l I - B)
static inline Symmetric shifted_adjugate(Symmetric b, real l) {
  const real x = l - b.xx, y = l - b.yy, z = l - b.zz;
  return symmetric(y * z - b.yz * b.yz, b.xz * b.yz + b.xy * z, b.xy * b.yz + b.xz * y, x * z - b.xz * b.xz,
                   b.xy * b.xz + b.yz * x, x * y - b.xy * b.xy);
}

/// Of a matrix nearly a aᵀ: its column along the largest diagonal entry.
static inline Vec3 largest_column(Symmetric a) {
  const Vec3 v = choose3(a.yy > a.xx, vec3(a.xy, a.yy, a.yz), vec3(a.xx, a.xy, a.xz));
  return choose3(a.zz > larger(a.xx, a.yy), vec3(a.xz, a.yz, a.zz), v);
}

/// The largest column of adj(l I - K), its length 1.
static inline Quaternion adjugate_column(Davenport k, real l) {
  const real ww = l - k.s, xx = l - k.B.xx, yy = l - k.B.yy, zz = l - k.B.zz;
  const real wx = -k.v.x, wy = -k.v.y, wz = -k.v.z, xy = -k.B.xy, xz = -k.B.xz, yz = -k.B.yz;
  // Minors of the last two rows and of the first two.
  const real l23 = yy * zz - yz * yz, l13 = xy * zz - xz * yz, l12 = xy * yz - xz * yy;
  const real l03 = wy * zz - wz * yz, l02 = wy * yz - wz * yy, l01 = wy * xz - wz * xy;
  const real f01 = ww * xx - wx * wx, f02 = ww * xy - wx * wy, f03 = ww * xz - wx * wz, f12 = wx * xy - xx * wy;
  const real a00 = xx * l23 - xy * l13 + xz * l12, a01 = -(wx * l23 - xy * l03 + xz * l02);
  const real a02 = wx * l13 - xx * l03 + xz * l01, a03 = -(wx * l12 - xx * l02 + xy * l01);
  const real a11 = ww * l23 - wy * l03 + wz * l02, a12 = -(ww * l13 - wx * l03 + wz * l01);
  const real a13 = ww * l12 - wx * l02 + wy * l01, a22 = f01 * zz - f03 * xz + wz * (wx * xz - xx * wz);
  const real a23 = -(f01 * yz - f02 * xz + wz * f12), a33 = f01 * yy - f02 * xy + wy * f12;
  Quaternion q = choose4(a11 > a00, quaternion(a01, a11, a12, a13), quaternion(a00, a01, a02, a03));
  q = choose4(a22 > larger(a00, a11), quaternion(a02, a12, a22, a23), q);
  return unit4(choose4(a33 > larger(larger(a00, a11), a22), quaternion(a03, a13, a23, a33), q));
}

/// A bound just above the largest eigenvalue s1 + s2 + s3 of K, si the singular values of M, det M = s1 s2 s3 >= 0,
/// from its characteristic quartic λ⁴ - 2 |M|² λ² - 8 det M λ + |M|⁴ - 4 |cof M|². `c`: cof M.
static inline real bound_above(Mat3 m, Mat3 c, real det) {
  const real f = inner3(m, m), g = inner3(c, c);
  // (s1 + s2 + s3)² = |M|² + 2 (s1 s2 + s2 s3 + s3 s1) with |cof M| <= the bracket <= √3 |cof M|.
  const real e = sqrt(g), x = sqrt(f + (real)3.4641017 * e), low = sqrt(x * x - (real)1.4641017 * e);
  const real p = ((x * x - (real)2 * f) * x - (real)8 * det) * x + f * f - (real)4 * g;
  const real d = ((real)4 * x * x - (real)4 * f) * x - (real)8 * det, dd = (real)12 * x * x - (real)4 * f;
  // A step of Laguerre's from above stays above, but for rounding.
  const real down = d + sqrt(positive((real)9 * d * d - (real)12 * p * dd));
  const real step = positive((real)4 * p / (down + (real)1e-30));
  return (real)1.0001 * larger(low, x - step);
}

/// q turned to the best in the plane of the identity and the axis u, a unit vector, as K looks from q.
static inline Quaternion best_about(Davenport k, Quaternion q, Vec3 u) {
  const Heading h = larger_heading(k.s, dot3(k.v, u), dot3(u, apply_symmetric(k.B, u)));
  return unit4(multiply4(q, quaternion(h.x, h.y * u.x, h.y * u.y, h.y * u.z)));
}

/// About the axis in which B is largest: near rank one the half turn about it is as good as the identity.
static inline Quaternion ascend_about_axis(Mat3 m, Quaternion q, real l) {
  const Davenport k = davenport_from(q, m);
  return best_about(k, q, unit3(largest_column(shifted_adjugate(k.B, larger(l, k.s)))));
}

/// Along Newton's direction (λ I - B)⁻¹ v, with λ safely above the largest eigenvalue.
static inline Quaternion ascend(Mat3 m, Quaternion q) {
  const Davenport k = davenport_from(q, m);
  const real l = k.s + sum_of_sizes(k.v) + (real)1e-6;
  return best_about(k, q, unit3(apply_symmetric(shifted_adjugate(k.B, l), k.v)));
}

/// B without its mean, tr B² = 6: eigenvalues 2 cos φ, 2 cos (φ ± 120°). 0 where B is a multiple of I.
static inline Symmetric deviator(Symmetric b) {
  const Symmetric d = add_symmetric(b, diagonal3((real)(-1. / 3) * (b.xx + b.yy + b.zz)));
  const real n = d.xx * d.xx + d.yy * d.yy + d.zz * d.zz + (real)2 * (d.xy * d.xy + d.xz * d.xz + d.yz * d.yz);
  const real q = sqrt((real)(1. / 6) * n);
  return scale_symmetric((real)1 / (q + (real)1e-30), d);
}

/// An eigenvector, of any length, of B's largest eigenvalue: first that of the eigenvalue farthest from the other two,
/// which is always well told, then the better in the plane it is normal to (Eberly 2014).
static inline Vec3 largest_direction(Symmetric b) {
  const Symmetric d = deviator(b);
  const real det =
      d.xx * (d.yy * d.zz - d.yz * d.yz) - d.xy * (d.xy * d.zz - d.yz * d.xz) + d.xz * (d.xy * d.yz - d.yy * d.xz);
  const real side = det < (real)0 ? (real)-1 : (real)1, e = fabs(det);
  // x³ - 3 x = e, √3 <= x <= 2: a parabola through three of its points, then Newton's.
  real x = (real)1.7320508 + ((real)0.1606942 - (real)0.0133598 * e) * e;
  x -= (x * x * x - (real)3 * x - e) / ((real)3 * x * x - (real)3);
  const Vec3 u = unit3(largest_column(shifted_adjugate(scale_symmetric(side, d), x)));
  const Vec3 v = choose3(fabs(u.x) > fabs(u.y), vec3(-u.z, (real)0, u.x), vec3((real)0, u.z, -u.y));
  const Vec3 w = cross3(u, v), dw = apply_symmetric(d, w);  // As long as v.
  const Heading h = larger_heading(dot3(v, apply_symmetric(d, v)), dot3(v, dw), dot3(w, dw));
  return choose3(det < (real)0, add3(scale3(h.x, v), scale3(h.y, w)), u);
}

static inline Mat3 normalized3(Mat3 m) {
  const real sum = fabs(m.x.x) + fabs(m.x.y) + fabs(m.x.z) + fabs(m.y.x) + fabs(m.y.y) + fabs(m.y.z) + fabs(m.z.x) +
                   fabs(m.z.y) + fabs(m.z.z);
  return scale_mat3((real)3 / (sum + (real)1e-37), m);
}

/// N = ±M, det N >= 0, normalized.
typedef struct {
  Mat3 n, cofactors;
  real det;
  int reflects;  // Whether N = -M.
} Unreflected;

static inline Unreflected unreflected(Mat3 matrix) {
  const Mat3 m = normalized3(matrix);
  Unreflected u;
  u.cofactors = cofactors3(m);
  const real det = dot3(m.x, u.cofactors.x);
  u.reflects = det < (real)0;
  u.n = scale_mat3(u.reflects ? (real)-1 : (real)1, m);
  u.det = fabs(det);
  return u;
}

/// Of the rotation closest to N. Steps 1 to 3.
static inline Quaternion closest_unreflected(Mat3 matrix) {
  const Unreflected u = unreflected(matrix);
  const real l = bound_above(u.n, u.cofactors, u.det);
  return ascend(u.n, ascend_about_axis(u.n, adjugate_column(davenport(u.n), l), l));
}

/// Step 4, from the quaternion that the others give.
static inline Mat3 finish_rotation(Mat3 matrix, Quaternion q) {
  const Unreflected u = unreflected(matrix);
  const Vec3 axis = largest_direction(scale_symmetric((real)-1, davenport_from(q, u.n).B));
  const Quaternion turned = multiply4(q, quaternion((real)0, axis.x, axis.y, axis.z));
  return rotation_of(unit4(choose4(u.reflects, turned, q)));
}

/// The identity where M is 0.
static inline Mat3 closest_rotation(Mat3 matrix) { return finish_rotation(matrix, closest_unreflected(matrix)); }

/// The scale s >= 0 that minimises |s R A - B|², from M = B Aᵀ and 1 / |A|², which is 0 where |A|² vanishes: then 1.
static inline real closest_scale(Mat3 rotation, Mat3 m, real inverse_spread) {
  const real s = positive(inner3(rotation, m) * inverse_spread);
  return inverse_spread == (real)0 ? (real)1 : s;
}
