// The rotation R closest to a matrix M: it maximises tr Rᵀ M. In C99 ∩ C++, after vec3.h, mat3.h and symmetric.h. No
// loops and no branches: every matrix takes the same way, a lane of a vector unit each.
//
// In the unit quaternion q of R the trace is qᵀ K q with Davenport's symmetric, traceless K, so q is the eigenvector of
// K's largest eigenvalue (Horn 1987). Where two or three largest eigenvalues nearly meet, that vector drowns in
// rounding error; they do where M reflects (near to double in the two smaller singular values) or has rank one. So:
//  1. A reflection is turned into a rotation of its negative, N = ±M, det N >= 0. That leaves rank one.
//  2. Horn for N: the eigenvalue λ by two steps of Halley's on K's quartic, the vector as a column of adj(λ I - K).
//  Near
//     rank one the adjugate is small and the rounding in it is not. K + λ I removes the half of that which shrinks the
//     trace: the other two eigenvalues are near -λ there.
//  3. P = Rᵀ N would now be symmetric, but near rank one a turn about its largest direction costs next to nothing: the
//     best of these turns is taken.
//  4. For a reflection the best is R's half turn about P's least direction instead.
// The trace misses the best by less than 1e-6 |M| in single and 1e-10 |M| in double precision.

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

/// The larger of a and 0, and of a and b but for rounding.
static inline real positive(real a) { return (real)0.5 * (a + fabs(a)); }
static inline real larger(real a, real b) { return a + positive(b - a); }

static inline Quaternion choose4(mask first, Quaternion a, Quaternion b) {
  return quaternion(first ? a.w : b.w, first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

static inline Quaternion multiply4(Quaternion a, Quaternion b) {
  return quaternion(a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                    a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w);
}

/// Of a quaternion of any length; the identity where that is 0.
static inline Mat3 rotation_of(Quaternion q) {
  const real least = (real)(sizeof(scalar) == sizeof(float) ? 1e-37 : 1e-300);
  const real s = (real)2 / (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z + least);
  const real x = s * q.x, y = s * q.y, z = s * q.z;
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

/// (K + λ I) q
static inline Quaternion apply_shifted(Davenport k, real l, Quaternion q) {
  return quaternion((k.s + l) * q.w + k.v.x * q.x + k.v.y * q.y + k.v.z * q.z,
                    k.v.x * q.w + (k.B.xx + l) * q.x + k.B.xy * q.y + k.B.xz * q.z,
                    k.v.y * q.w + k.B.xy * q.x + (k.B.yy + l) * q.y + k.B.yz * q.z,
                    k.v.z * q.w + k.B.xz * q.x + k.B.yz * q.y + (k.B.zz + l) * q.z);
}

/// The largest column of adj(λ I - K).
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
  return choose4(a33 > larger(larger(a00, a11), a22), quaternion(a03, a13, a23, a33), q);
}

/// K's characteristic polynomial, λ⁴ - 2 f λ² - 8 d λ + f² - 4 g with f = |M|², d = det M, g = |cof M|².
typedef struct {
  real f, d, g;
} Quartic;

/// A step of Halley's towards the largest root, from above. Never up.
static inline real step_down(Quartic k, real x) {
  const real p = ((x * x - (real)2 * k.f) * x - (real)8 * k.d) * x + k.f * k.f - (real)4 * k.g;
  const real slope = ((real)4 * x * x - (real)4 * k.f) * x - (real)8 * k.d, bend = (real)12 * x * x - (real)4 * k.f;
  return x - positive((real)2 * p * slope / ((real)2 * slope * slope - p * bend + (real)1e-30));
}

/// Just above the largest eigenvalue s1 + s2 + s3 of K, si the singular values of M, det M = s1 s2 s3 >= 0.
static inline real eigenvalue_bound(Quartic k) {
  // (s1 + s2 + s3)² = |M|² + 2 (s1 s2 + s2 s3 + s3 s1) with |cof M| <= the bracket <= √3 |cof M|.
  const real e = sqrt(k.g), square = k.f + (real)3.4641017 * e, inverse = (real)1 / sqrt(square + (real)1e-30);
  const real least = inverse * (square - (real)0.8 * e);  // Rounding near rank one must not lead below.
  const real x = step_down(k, step_down(k, inverse * square));
  return (real)(sizeof(scalar) == sizeof(float) ? 1.00001 : 1.000000001) * larger(least, x);
}

/// Of the rotation closest to N, of any length, but for turns near rank one. Step 2.
static inline Quaternion closest_quaternion(Mat3 n, Mat3 cofactors, real det) {
  Quartic quartic;
  quartic.f = inner3(n, n);
  quartic.d = det;
  quartic.g = inner3(cofactors, cofactors);
  const real l = eigenvalue_bound(quartic);
  const Davenport k = davenport(n);
  return apply_shifted(k, l, adjugate_column(k, l));
}

/// A direction in the plane of two vectors, by its parts of each.
typedef struct {
  real x, y;
} Heading;

/// The eigenvector of the larger eigenvalue of a quadratic form in the plane of two vectors at right angles, the second
/// √n times as long as the first: a and b are its values on them, o on both. The first where either will do.
static inline Heading larger_heading(real a, real o, real b, real n) {
  const real h = (real)0.5 * (n * a - b), r = sqrt(h * h + n * o * o);
  const mask near_first = h >= (real)0;
  const real least = (real)(sizeof(scalar) == sizeof(float) ? 1e-8 : 1e-16);
  Heading heading;
  heading.x = near_first ? r + h + least : n * o;
  heading.y = near_first ? o : r - h;
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

/// B without its mean and made so long that its eigenvalues are 2 cos φ, 2 cos (φ ± 120°). 0 where B is a multiple of
/// I.
static inline Symmetric deviator(Symmetric b) {
  const Symmetric d = add_symmetric(b, diagonal3((real)(-1. / 3) * (b.xx + b.yy + b.zz)));
  const real n = d.xx * d.xx + d.yy * d.yy + d.zz * d.zz + (real)2 * (d.xy * d.xy + d.xz * d.xz + d.yz * d.yz);
  return scale_symmetric((real)1 / (sqrt((real)(1. / 6) * n) + (real)1e-30), d);
}

static inline real determinant(Symmetric d) {
  return d.xx * (d.yy * d.zz - d.yz * d.yz) - d.xy * (d.xy * d.zz - d.yz * d.xz) + d.xz * (d.xy * d.yz - d.yy * d.xz);
}

/// The root x in √3 .. 2 of x³ - 3 x = e, 0 <= e <= 2, to 2e-6.
static inline real outer_root(real e) {
  return (real)1.7320521 +
         e * ((real)0.16661886 + e * ((real)-0.023762507 +
                                      e * ((real)0.0054749068 + e * ((real)-0.0011208064 + e * (real)0.00012170635))));
}

/// An eigenvector, of any length, of B's largest eigenvalue: first that of the eigenvalue farthest from the other two,
/// which is always well told, then the better in the plane it is normal to (Eberly 2014).
static inline Vec3 largest_direction(Symmetric b) {
  const Symmetric d = deviator(b);
  const real det = determinant(d), root = outer_root(fabs(det));
  const mask farthest_is_least = det < (real)0;
  const Vec3 u = largest_column(shifted_adjugate(d, farthest_is_least ? -root : root));
  const Vec3 v = choose3(fabs(u.x) > fabs(u.y), vec3(-u.z, (real)0, u.x), vec3((real)0, u.z, -u.y));
  const Vec3 w = cross3(u, v), dw = apply_symmetric(d, w);
  const Heading h = larger_heading(dot3(v, apply_symmetric(d, v)), dot3(v, dw), dot3(w, dw), dot3(u, u));
  return choose3(farthest_is_least, add3(scale3(h.x, v), scale3(h.y, w)), u);
}

/// Steps 3 and 4.
static inline Quaternion finish_quaternion(Mat3 n, Quaternion q, mask reflects) {
  const Davenport k = davenport(transpose_times(rotation_of(q), n));
  const Vec3 axis = largest_direction(scale_symmetric(reflects ? (real)-1 : (real)1, k.B));
  const Heading h = larger_heading(k.s, dot3(k.v, axis), dot3(axis, apply_symmetric(k.B, axis)), dot3(axis, axis));
  const real cosine = reflects ? (real)0 : h.x;
  const Vec3 sine = scale3(reflects ? (real)1 : h.y, axis);
  return multiply4(q, quaternion(cosine, sine.x, sine.y, sine.z));
}

/// The sum of its entries' sizes 3.
static inline Mat3 normalized3(Mat3 m) {
  const real sum = fabs(m.x.x) + fabs(m.x.y) + fabs(m.x.z) + fabs(m.y.x) + fabs(m.y.y) + fabs(m.y.z) + fabs(m.z.x) +
                   fabs(m.z.y) + fabs(m.z.z);
  return scale_mat3((real)3 / (sum + (real)1e-37), m);
}

/// The identity where M is 0.
static inline Mat3 closest_rotation(Mat3 matrix) {
  const Mat3 m = normalized3(matrix), cofactors = cofactors3(m);
  const real det = dot3(m.x, cofactors.x);
  const mask reflects = det < (real)0;
  const Mat3 n = scale_mat3(reflects ? (real)-1 : (real)1, m);
  return rotation_of(finish_quaternion(n, closest_quaternion(n, cofactors, fabs(det)), reflects));
}

/// The scale s >= 0 that minimises |s R A - B|², from M = B Aᵀ and 1 / |A|², which is 0 where |A|² vanishes: then 1.
static inline real closest_scale(Mat3 rotation, Mat3 m, real inverse_spread) {
  const real s = positive(inner3(rotation, m) * inverse_spread);
  return inverse_spread == (real)0 ? (real)1 : s;
}
